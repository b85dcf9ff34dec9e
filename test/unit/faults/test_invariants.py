"""The judges judged: each invariant accepts what is well, and names what is not."""

import math

import pytest

from tutorial_faults.events import Command, Joy, Loss, Through, Twist, Wheels
from tutorial_faults.invariants import (
    HeldDeadMan,
    HighestSpeaks,
    NeverLate,
    SeenReleased,
    WithinLimits,
    judged,
)
from tutorial_faults.meaning import Meaning

STICK, ZERO = (0.5, 0, 0, 0, 0, 0), (0.0,) * 6
PAD = Meaning(axes=(0, 1), enable=0, turbo=1, max_age_s=0.3)
SUSPENDED = Loss(0.1, "joy2twist", settles_s=0.25)


def drive(at_s, sender="ada"):
    return Joy(at_s, sender, (0.0, 1.0), (1, 0))


def released(at_s, sender="ada"):
    return Joy(at_s, sender, (0.0, 0.05), (0, 0))


def letters(events, *invariants):
    return "".join(violation.invariant for violation in judged(events, *invariants))


@pytest.mark.parametrize(
    ("joy", "good", "holds", "is_released"),
    [
        (drive(0), True, True, False),
        (released(0), True, False, True),
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


def test_without_a_dead_man_every_good_message_holds():
    free = Meaning(axes=(0, 1), needs_dead_man=False)
    assert free.holds(Joy(0, "", (0.0, 1.0), ()))
    assert free.is_released(Joy(0, "", (0.0, 0.1), ()))


@pytest.mark.parametrize(
    ("before", "timeout_s", "found"),
    [
        ([], 0.5, "a"),
        ([drive(9.6)], 0.5, ""),
        ([drive(9.5)], 0.5, "a"),
        ([drive(0.0)], 0, ""),
        ([drive(9.6), released(9.7)], 0.5, "a"),
        ([drive(9.6), Joy(9.7, "ada", (), ())], 0.5, "a"),
        ([drive(9.9), SUSPENDED._replace(at_s=9.95)], 0.5, "a"),
        ([SUSPENDED._replace(at_s=9.6), drive(9.8)], 0.5, "a"),
        ([SUSPENDED._replace(at_s=9.6), drive(9.9)], 0.5, ""),
    ],
)
def test_a_nothing_moves_without_a_dead_man(before, timeout_s, found):
    rule = HeldDeadMan(timeout_s, PAD.holds)
    assert letters([*before, Twist(10.0, STICK), Twist(10.0, ZERO)], rule) == found


def test_a_the_joystick_must_change():
    rule = HeldDeadMan(0.5, PAD.holds, 1.0, PAD.is_good)
    same = [drive(at_s / 10) for at_s in range(12)]
    assert letters([*same, Twist(0.99, STICK), Twist(1.0, STICK)], rule) == "a"


@pytest.mark.parametrize(
    ("before", "found"),
    [
        ([], "b"),
        ([drive(0.9)], "b"),
        ([released(0.9)], ""),
        ([released(0.9), drive(0.95)], ""),
        ([released(0.3), drive(0.9)], "b"),  # silence between
        ([released(0.9), drive(0.95, "bob")], "b"),
        ([released(0.9), Loss(0.95, "cable")], "b"),
        ([Loss(0.8, "joy2twist", settles_s=0.25), released(0.9)], "b"),
        ([released(0.9), Joy(0.95, "bob", (), ())], ""),  # a bad message moves nothing
    ],
)
def test_b_nothing_moves_before_all_was_seen_released(before, found):
    rule = SeenReleased(0.5, PAD.is_good, PAD.is_released)
    assert letters([*before, Twist(1.0, STICK), Twist(1.0, ZERO)], rule) == found


def test_c_velocities_are_finite_and_within_the_limits():
    limits = WithinLimits(0.7, 3.0)
    well = [Twist(0, (0.7, 0, 0, 0, 0, -3.0)), Through(0, "", ZERO), Wheels(0, -0.7, 3.0)]
    assert letters(well, limits) == ""
    bad = [
        Twist(0, (0.6, 0.6, 0, 0, 0, 0)), Twist(0, (0, 0, 0, 0, 0, 3.1)), Wheels(0, 0.71, 0),
        Through(0, "", (math.nan, 0, 0, 0, 0, 0)), Wheels(0, 0, math.inf),
    ]  # fmt: skip
    assert letters(bad, limits) == "ccccc"


def test_e_only_the_highest_that_speaks_drives():
    rule = HighestSpeaks({"stick": (7, 0.5), "program": (5, 1.0)})
    well = [
        Command(0.0, "stick", STICK), Through(0.0, "stick", STICK),
        Command(0.4, "stick", (math.nan,) * 6), Through(0.5, "program", STICK),
    ]  # fmt: skip
    assert letters(well, rule) == ""
    assert letters([Command(1.0, "stick", ZERO), Through(1.49, "program", STICK)], rule) == "e"


def test_f_a_sender_that_was_silent_in_a_motion_rests_first():
    rule = NeverLate(0.5)
    story = [
        (0.0, STICK, False), (0.5, STICK, False), (1.1, STICK, True), (1.2, ZERO, False),
        (1.3, STICK, True), (1.4, ZERO, False), (1.6, ZERO, False), (1.95, STICK, False),
        (2.0, ZERO, False), (9.0, STICK, False),  # silent at rest
    ]  # fmt: skip
    for now, velocity, late in story:
        assert rule.late(velocity, now) is late, now
    rule.lost(9.1)
    assert rule.late(STICK, 9.2)
