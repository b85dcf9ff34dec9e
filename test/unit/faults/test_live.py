"""The judge of the live hunt condemns a planted stream by the letter of what it violates."""

import pytest

from tutorial_faults.live.judge import BEGINS, ENDS, HANDS, WHEELS, Event, Trial, velocity

STAND, GO, FAST = velocity(0.0, 0.0), velocity(0.3, 0.0), velocity(0.8, 0.0)
HOLD, LET_GO = Event(0.1, HANDS, "drive"), Event(1.0, HANDS, "released")


def wheels(*phases):
    """Odometry of 50 Hz. phases: (until [s], velocity)."""
    begins = (0.0, *(until for until, _ in phases))
    return [
        Event(begin + 0.02 * number, WHEELS, velocity)
        for begin, (until, velocity) in zip(begins, phases)
        for number in range(round((until - begin) / 0.02))
    ]


def fault(name, begin=0.5, end=0.9):
    return [Event(begin, BEGINS, name), Event(end, ENDS, name)]


@pytest.mark.parametrize(
    ("stream", "letters"),
    [
        ([LET_GO, *wheels((1.6, GO), (3.0, STAND))], ""),
        ([LET_GO, *wheels((1.7, GO), (3.0, STAND))], "a"),
        (fault("stop:mux", end=2.0) + wheels((1.1, GO), (3.0, STAND)), ""),
        (fault("stop:mux", end=2.0) + wheels((1.2, GO), (3.0, STAND)), "d"),
        (fault("stop:mux") + wheels((0.7, GO), (1.0, STAND), (1.5, GO)), "b"),
        (fault("odd:joy") + wheels((0.7, GO), (1.0, STAND), (1.5, GO)), ""),
        (wheels((1.0, FAST)), "c"),
        (fault("stop:master") + wheels((2.0, GO)), ""),
        (fault("stop:master") + wheels((0.7, GO), (2.0, STAND)), "h"),
    ],
)
def test_a_stream_is_condemned_by_what_its_wheels_do(stream, letters):
    assert "".join(one.invariant for one in Trial([HOLD, *stream]).violations) == letters
