"""The results of the hunt as a file, a table and a last line; and what a soak measures."""

import io

from tutorial_faults.live.relay import LONGEST_QUEUE, Cable
from tutorial_faults.live.samples import Sample, complaints, growth
from tutorial_faults.live.soak_observer import RESTS_S, Laps
from tutorial_faults.live.table import Result, beside, by_kind, last_line, read, write

RESULTS = [
    Result(1, ("unplug",), 0.1, ()),
    Result(2, ("unplug", "loss"), 0.25, ("a", "d")),
    Result(3, (), 0.0, ()),
]


def test_what_is_written_is_read_again():
    file = io.StringIO()
    write(file, RESULTS[:1])
    write(file, RESULTS[1:], header=False)
    file.seek(0)
    assert read(file) == RESULTS


def test_the_last_line():
    assert last_line(RESULTS) == "3 trials, 3 faults, 1 violations, worst time to rest 0.25 s"
    assert last_line([]) == "0 trials, 0 faults, 0 violations, worst time to rest 0.00 s"


def test_a_row_for_each_kind_that_came():
    assert by_kind(RESULTS)[2:] == [
        "| `unplug` | 1 | 1 | 1 | 0.10, 0.25 |",
        "| `loss` | 0 | 1 | 1 | -, 0.25 |",
    ]


def test_how_often_each_invariant_is_violated_beside_ours():
    assert beside({"theirs": RESULTS, "ours": RESULTS[:1]}) == [
        "| invariant | theirs, of 3 | ours, of 1 |",
        "|---|---|---|",
        "| a | 1 | 0 |",
        "| d | 1 | 0 |",
        "| worst time to rest [s] | 0.25 | 0.10 |",
    ]


def samples(memory, threads=(5, 5), files=(9, 9)):
    """Samples each 10 s for 10 minutes; memory: a function of the time."""
    return [
        Sample(at_s, "/node", memory(at_s), threads[at_s > 60], files[at_s > 60])
        for at_s in map(float, range(0, 600, 10))
    ]


def test_memory_that_comes_and_goes_is_no_growth():
    flat = samples(lambda at_s: 50_000 + int(at_s) % 300)
    assert growth(flat, "/node")[0] < 300
    assert complaints(flat) == []


def test_a_thread_that_comes_and_goes_is_no_growth():
    steady = samples(lambda at_s: 50_000)
    steady[-3] = steady[-3]._replace(threads=6, files=10)
    assert complaints(steady) == []


def test_what_grows_is_named():
    assert complaints(samples(lambda at_s: 50_000 + 10 * int(at_s))) == [
        "/node: grew by 4800 kB, 0 threads, 0 files"
    ]
    assert complaints(samples(lambda at_s: 50_000, threads=(5, 6), files=(9, 10))) == [
        "/node: grew by 0 kB, 1 threads, 1 files"
    ]


def test_a_node_that_ended_soon_is_named():
    assert complaints(samples(lambda at_s: 1)[:3]) == ["/node: did not live for longer than 60 s"]


def test_a_lap_closes_once_in_a_long_rest():
    laps, now, closed = Laps(), 0.0, []
    for moving, seconds in ((True, 5.0), (False, 1.3), (True, 5.0), (False, 2.3), (True, 1.0)):
        for _ in range(round(seconds / 0.02)):
            now += 0.02
            if laps.closes(moving, now):
                closed.append(now)
    assert len(closed) == 1
    assert 11.3 + RESTS_S < closed[0] < 11.3 + RESTS_S + 0.1


class Always:
    """Chance that is always the same."""

    def __init__(self, value):
        self._value = value

    def random(self):
        return self._value


def test_a_cable_without_ills_delivers_once_and_at_once():
    assert Cable(Always(0.0)).sends("a", 100, 5.0) == [5.0]


def test_each_ill_of_a_cable():
    for ill, value, expected in (
        ("down", 1.0, []),
        ("loss", 0.5, []),
        ("delay", 0.2, [5.2]),
        ("duplication", 0.5, [5.0, 5.001]),
        ("reordering", 0.5, [5.05]),
        ("throttle", 1000.0, [5.1]),
    ):
        cable = Cable(Always(0.25))
        cable.ills[ill] = value
        assert cable.sends("a", 100, 5.0) == expected, ill


def test_a_slow_cable_queues_and_then_drops():
    cable = Cable(Always(0.9))
    cable.ills["throttle"] = 1024.0  # [bytes/s]
    times = [time for _ in range(100) for time in cable.sends("a", 128, 0.0)]
    assert times == [0.125 * number for number in range(1, LONGEST_QUEUE // 128 + 1)]
    assert cable.sends("b", 128, 0.0) == [0.125]  # the other way is free
