"""The judges judged, where no defence that is taken away does it (see defences.py)."""

import math

import pytest

from tutorial_faults.events import Command, Joy, Loss, Through, Twist, Wheels
from tutorial_faults.invariants import (
    HeldDeadMan,
    HighestSpeaks,
    NeverLate,
    RestsFirst,
    SeenReleased,
    WithinLimits,
    judged,
)
from tutorial_faults.meaning import Meaning

STICK, ZERO = (0.5, 0, 0, 0, 0, 0), (0.0,) * 6
PAD = Meaning(axes=(0, 1), enable=0, turbo=1, max_age_s=0.3)
DRIVE = Joy(9.9, "ada", (0.0, 1.0), (1, 0))
RELEASED = Joy(9.8, "ada", (0.0, 0.05), (0, 0))
MOVES = [Twist(10.0, ZERO), Twist(10.0, STICK)]


def letters(events, *invariants):
    return "".join(violation.invariant for violation in judged(events, *invariants))


@pytest.mark.parametrize(
    ("joy", "good", "holds", "is_released"),
    [
        (DRIVE, True, True, False),
        (RELEASED, True, False, True),
        (Joy(0, "", (0.0, 0.0), (0, 1)), True, True, False),
        (Joy(0, "", (0.0, 0.11), (0, 0)), True, False, False),
        (Joy(0, "", (0.0, 1.0, math.nan), (1, 0)), False, False, False),
        (Joy(0, "", (0.0, 2e6), (1, 0)), False, False, False),
        (Joy(0, "", (0.0,), (1, 0)), False, False, False),
        (Joy(0, "", (0.0, 0.0), (1,)), False, False, False),
        (Joy(0, "", (0.0, 0.0), (0, 0), age_s=0.31), False, False, False),
    ],
)
def test_what_a_joy_means(joy, good, holds, is_released):
    assert (PAD.is_good(joy), PAD.holds(joy), PAD.is_released(joy)) == (good, holds, is_released)


@pytest.mark.parametrize(
    ("before", "a", "b"),
    [
        ([], "a", "b"),
        ([DRIVE], "", "b"),
        ([RELEASED], "a", ""),
        ([RELEASED, DRIVE], "", ""),
        ([RELEASED._replace(at_s=9.3), DRIVE], "", "b"),  # silence between
        ([RELEASED, DRIVE._replace(at_s=9.5)], "a", ""),
        ([RELEASED, DRIVE._replace(sender="bob")], "", "b"),
        ([RELEASED, DRIVE, Loss(9.95, "cable")], "", "b"),
        ([Loss(9.7, "joy2twist", settles_s=0.25), RELEASED, DRIVE], "a", "b"),
        ([RELEASED, DRIVE, Joy(9.95, "bob", (), ())], "a", ""),  # a bad message
    ],
)
def test_a_and_b_of_a_motion(before, a, b):
    assert letters([*before, *MOVES], HeldDeadMan(0.5, PAD.holds)) == a
    assert letters([*before, *MOVES], SeenReleased(0.5, PAD.is_good, PAD.is_released)) == b


def test_c_e_and_f():
    bad = [
        Twist(0, (0.6, 0.6, 0, 0, 0, 0)), Twist(0, (0, 0, 0, 0, 0, 3.1)), Wheels(0, 0.71, 0),
        Through(0, "", (math.nan, 0, 0, 0, 0, 0)), Wheels(0, 0, math.inf),
    ]  # fmt: skip
    well = [Twist(0, (0.7, 0, 0, 0, 0, -3.0)), Through(0, "", ZERO), Wheels(0, -0.7, 3.0)]
    assert letters([*well, *bad], WithinLimits(0.7, 3.0)) == "ccccc"
    speaks = [Command(0.0, "stick", STICK), Command(0.4, "stick", (math.nan,) * 6)]
    program = [Through(at_s, "program", STICK) for at_s in (0.49, 0.5)]
    rule = HighestSpeaks({"stick": (7, 0.5), "program": (5, 1.0)})
    assert letters([*speaks, *program], rule) == "e"
    rule = RestsFirst()
    assert [rule.take(STICK, at_s) for at_s in (0.0, 0.5, 1.1)] == [False, False, True]
    rule = NeverLate()
    steps = [(0.0, False), (0.5, False), (1.1, False), (1.115, True), (1.34, True), (1.36, False)]
    assert [(rule.take(STICK, s), rule.late(s))[1] for s, _ in steps] == [late for _, late in steps]
