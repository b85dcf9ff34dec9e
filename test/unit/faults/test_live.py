"""The command line and the results of the hunt, its cable, and what a soak measures."""

import pytest

from tutorial_faults.live import program
from tutorial_faults.live.relay import LONGEST_QUEUE, Cable
from tutorial_faults.live.report import Result, by_kind, last_line
from tutorial_faults.live.samples import Sample, complaints

RESULTS = [
    Result(1, ("unplug",), 0.1, ()),
    Result(2, ("unplug", "loss"), 0.25, ("a", "d")),
    Result(3, (), 0.0, ()),
]


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        *((["--for", text], "not a number above 0") for text in ("-1", "0", "nan", "inf", "")),
        *((["--trials", text], "not a whole number") for text in ("-5", "0", "1.5", "many", "")),
        (["--for", "60", "--trials", "5"], "not allowed with argument --for"),
        (["--table", "nodir/x.csv"], "can't open 'nodir/x.csv': [Errno 2] No such file"),
        (["--kinds", "lost"], "lost: is no kind of fault; there are "),
        (["--node", "joy2twist"], "joy2twist: not PACKAGE/TYPE"),
    ],
)
def test_a_bad_command_line_is_one_line_and_no_trial(arguments, why, capsys):
    with pytest.raises(SystemExit) as ended:
        program.main(arguments)
    assert ended.value.code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("./tutorial test faults: ") and why in line


@pytest.mark.parametrize("seed", [None, 0])
def test_without_a_seed_the_first_line_says_how_to_repeat_it(seed, monkeypatch, capsys):
    seeds, arguments = [], ["--trials", "2", "--kinds", "stop"]
    monkeypatch.setattr(program.hosts, "move_in", lambda arguments: None)
    monkeypatch.setattr(program.signal, "signal", lambda *_: None)
    monkeypatch.setattr(program, "hunt", lambda options: seeds.append(options.seed) or 0)
    assert program.main([*arguments, *([] if seed is None else ["--seed", str(seed)])]) == 0
    again = "./tutorial test faults --trials 2 --kinds stop --seed 1"
    line = f"faults: seed 1; the same again: {again}\n"
    assert (seeds, capsys.readouterr().out) == (([1], line) if seed is None else ([0], ""))


def test_the_results():
    assert RESULTS[1].row() == [2, "unplug+loss", "0.250", "ad"]
    assert last_line(RESULTS) == "3 trials, 3 faults, 1 violations, worst time to rest 0.25 s"
    assert last_line([]) == "0 trials, 0 faults, 0 violations, worst time to rest 0.00 s"
    assert by_kind(RESULTS)[2:] == ["| `unplug` | 2 | 1 | 0.25 |", "| `loss` | 1 | 1 | 0.25 |"]


def samples(memory, threads=(5, 5), files=(9, 9)):
    """Return samples each 10 s for 10 minutes; memory: a function of the time."""
    return [
        Sample(at_s, "/node", memory(at_s), threads[at_s > 60], files[at_s > 60])
        for at_s in map(float, range(0, 600, 10))
    ]


STEADY = samples(lambda at_s: 50_000 + int(at_s) % 300)
PEAK = [*STEADY[:-3], STEADY[-3]._replace(threads=6, files=10), *STEADY[-2:]]


@pytest.mark.parametrize(
    ("seen", "lines"),
    [
        (PEAK, []),
        (samples(lambda at_s: 50_000 + 10 * int(at_s)), ["grew by 4800 kB, 0 threads, 0 files"]),
        (samples(lambda at_s: 0, (5, 6), (9, 10)), ["grew by 0 kB, 1 threads, 1 files"]),
        (STEADY[:3], ["did not live for longer than 60 s"]),
    ],
)
def test_what_grows_is_named_and_what_comes_and_goes_does_not_grow(seen, lines):
    assert complaints(seen) == [f"/node: {line}" for line in lines]


class Always:
    """Chance that is always the same."""

    def __init__(self, value):
        self.random = lambda: value


def test_each_ill_of_a_cable():
    assert Cable(Always(0.0)).sends("a", 100, 5.0) == [5.0]
    for ill, value, expected in (
        ("link_down", 1.0, []),
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
