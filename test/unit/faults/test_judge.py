"""The judge of a trial, with records written by hand: what it finds, and what it accepts."""

import math

import pytest

from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.live.judge import LIMIT_S, Injury, Record, judge
from tutorial_faults.live.kinds import KINDS

DT = 0.02
HELD, LET_GO = [(0.0, "drive")], [(0.0, "drive"), (1.0, "released")]
STOPS_AND_GOES = ((0.5, 0.3), (0.8, 0.0), (1.5, 0.3))
FAST = Twist(0.5, (0.0, 0.0, 0.0, 0.0, 0.0, 2.1))
NAN = Twist(0.5, (math.nan, 0.0, 0.0, 0.0, 0.0, 0.0))
TELEOP, LOWER = Twist(1.0, (0.3, 0, 0, 0, 0, 0)), Twist(1.5, (0, 0.1, 0, 0, 0, 0))
TWO = [Injury("stop:joy_node", 0.5, 2.0), Injury("stop:mux", 0.9, 2.0)]
HUNG, UNPLUGGED = Injury("hang_master", 0.3, 0.9), Injury("unplug", 0.5, 2.0)
CELL = {"is_safe": True, "bumpers": [(0.0, 0)], "drops": [(0.0, 0)]}
FELL = {**CELL, "drops": [(0.0, 0), (1.0, 1)]}


def wheels(*phases):
    """Return odometry of 50 Hz. phases: (until [s], speed [m/s])."""
    made, now = [], 0.0
    for until, speed in phases:
        while now < until - 1e-9:
            made.append(Wheels(now, speed, 0.0))
            now += DT
    return made


def found(hands, injuries, *turn, **more):
    """Return the letters of the invariants that are violated."""
    judgement = judge(Record(list(hands), list(injuries), wheels(*turn), **more))
    return "".join(v.invariant for v in judgement.violations)


def turn(until):
    return ((until, 0.3), (2.5, 0.0))


@pytest.mark.parametrize(
    ("hands", "injuries", "phases", "letters"),
    [
        (LET_GO, [], turn(1.1), ""),
        (LET_GO, [], turn(1.0 + LIMIT_S - DT), ""),
        (LET_GO, [], turn(1.0 + LIMIT_S + 2 * DT), "a"),
        ([(0.0, "drive"), (1.0, "stick")], [], turn(1.0 + LIMIT_S + 2 * DT), "a"),
        (HELD, [UNPLUGGED], turn(1.0), ""),
        (HELD, [UNPLUGGED], turn(0.5 + LIMIT_S + 2 * DT), "d"),
        (HELD, [Injury("kill:joy_node", 0.5, 2.0)], turn(1.3), "d"),
        # A loss that is over before the limit stops nothing.
        (HELD, [Injury("stop:mux", 0.5, 0.9)], ((2.0, 0.3),), ""),
        # Of two losses the second counts if it came before rest was due.
        (HELD, TWO, turn(1.4), ""),
        (HELD, TWO[:1], turn(1.4), "d"),
        (HELD, [TWO[0], Injury("stop:mux", 0.5 + LIMIT_S + DT, 2.0)], turn(1.4), "d"),
        # A lost base shows no wheels.
        (HELD, [Injury("stop:base", 0.5, 1.9)], ((2.0, 0.3),), ""),
        # Late packets may take their time.
        (LET_GO, [Injury("loss", 0.5, 1.5)], turn(1.9), ""),
        (LET_GO, [Injury("duplication", 0.5, 1.5)], turn(1.9), "a"),
        # Wheels that stood turn again, without a release, with one, with one before they stood.
        (HELD, [Injury("stop:mux", 0.3, 0.6)], STOPS_AND_GOES, "b"),
        ([(0, "drive"), (0.6, "released"), (0.75, "drive")], [Injury("stop:mux", 0.3, 0.6)],
         STOPS_AND_GOES, ""),
        ([(0, "drive"), (0.1, "released"), (0.3, "drive")], [Injury("stop:mux", 0.5, 0.6)],
         ((0.12, 0.3), (0.32, 0.0), (0.6, 0.3), (0.8, 0.0), (1.5, 0.3)), "b"),
        (HELD, [Injury("link_down", 0.3, 0.6)], STOPS_AND_GOES, "f"),
        # A fault elsewhere stops the robot; or another fault beside it may.
        (HELD, [HUNG], ((1.5, 0.3),), ""),
        (HELD, [HUNG], turn(0.5), "h"),
        (HELD, [HUNG, Injury("stop:mux", 0.4, 1.5)], turn(0.5), ""),
        (HELD, [], ((1.0, 0.8),), "c"),
    ],
)  # fmt: skip
def test_a_record_and_its_judgement(hands, injuries, phases, letters):
    assert found(hands, injuries, *phases) == letters


def pushed(*changes):
    return {**CELL, "bumpers": [(0.0, 0), *changes]}


@pytest.mark.parametrize(
    ("hands", "injuries", "phases", "more", "letters"),
    [
        # (c): not finite, or beyond the limit.
        (HELD, [], ((1.0, 0.3),), {"commands": [NAN]}, "c"),
        (HELD, [], ((1.0, 0.3),), {"asked": [FAST]}, "c"),
        # (e): a lower input drives while teleop speaks. A mux that was restarted has heard nothing.
        (HELD, [], ((2.0, 0.3),), {"commands": [TELEOP, LOWER]}, "e"),
        (HELD, [], ((2.0, 0.3),), {"commands": [TELEOP, LOWER._replace(at_s=2.1)]}, ""),
        (HELD, [Injury("kill:mux", 1.1, 1.4)], ((1.5, 0.3),), {"commands": [TELEOP, LOWER]}, ""),
        # (i): a push that lasts, also to the end; a fall.
        (HELD, [], ((1.5, 0.3),), pushed((0.5, 1), (0.9, 0)), ""),
        (HELD, [], ((1.5, 0.3),), pushed((0.5, 1), (0.6, 2), (0.7, 1), (1.1, 0)), "i"),
        (HELD, [], ((1.5, 0.3),), pushed((0.5, 1)), "i"),
        (HELD, [], ((1.5, 0.3),), pushed((0.5, 1), (0.9, 0), (0.92, 1), (1.3, 0)), ""),
        (HELD, [], ((1.5, 0.3),), FELL, "i"),
        (HELD, [Injury("stop:joy_node", 0.5, 0.9)], ((1.5, 0.3),), FELL, "i"),
        # Without mux or base nothing can back it off.
        (HELD, [Injury("stop:mux", 0.5, 0.9)], ((1.5, 0.3),), FELL, ""),
        # In a cell backing off is no violation, and driving on is.
        (LET_GO, [], ((1.1, 0.3), (2.5, -0.1)), CELL, ""),
        (LET_GO, [], ((2.5, 0.3),), CELL, "a"),
        (HELD, [UNPLUGGED], ((1.0, 0.3), (1.2, -0.1), (2.5, 0.0)), CELL, ""),
        (HELD, [UNPLUGGED], ((2.5, 0.3),), CELL, "d"),
        (HELD, [HUNG], ((0.5, 0.3), (0.7, -0.1), (0.9, 0.3)), CELL, ""),
    ],
)
def test_a_record_of_more_than_hands_and_wheels(hands, injuries, phases, more, letters):
    assert found(hands, injuries, *phases, **more) == letters


@pytest.mark.parametrize("kind", [kind.name for kind in KINDS.values() if not kind.rearms])
def test_what_is_no_loss_asks_for_no_release(kind):
    assert found(HELD, [Injury(kind, 0.3, 0.6)], *STOPS_AND_GOES) == ""


def test_the_time_to_rest():
    record = Record(HELD, [Injury("stop:mux", 0.5, 2.0)], wheels(*turn(1.0)))
    assert judge(record).rest_s == pytest.approx(0.5, abs=DT)


def test_h_odometry_that_falls_silent():
    gap = [one for one in wheels((1.5, 0.3)) if not 0.5 < one.at_s < 0.9]
    assert [v.invariant for v in judge(Record(HELD, [HUNG], gap)).violations] == ["h"]


def test_of_each_invariant_the_first_violation_and_those_that_were_reported():
    reported = [Violation("g", 0.7, "did not exit")]
    fast = [FAST, FAST._replace(at_s=0.6)]
    assert found(HELD, [], (1.0, 0.3), commands=fast, reported=reported) == "cg"
