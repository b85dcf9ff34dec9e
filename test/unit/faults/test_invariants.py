"""The judges judged: each invariant lets through what is well, and names what is not."""

import math

import pytest

from tutorial_faults.events import Command, Joy, Loss, Through, Twist, Wheels
from tutorial_faults.invariants import (
    GoesOn,
    HeldDeadMan,
    HighestSpeaks,
    NeverLate,
    SeenReleased,
    SoonAtRest,
    WithinLimits,
    is_late,
    judged,
    unended,
)
from tutorial_faults.meaning import Meaning

STICK, ZERO = (0.5, 0, 0, 0, 0, 0), (0.0,) * 6
PAD = Meaning(axes=(0, 1), enable=0, turbo=1, max_age_s=0.3)


def drive(at_s, sender="ada"):
    return Joy(at_s, sender, (0.0, 1.0), (1, 0))


def released(at_s, sender="ada"):
    return Joy(at_s, sender, (0.0, 0.05), (0, 0))


def letters(events, *invariants):
    return [violation.invariant for violation in judged(events, *invariants)]


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
    assert not free.holds(Joy(0, "", (0.0, math.inf), ()))


@pytest.mark.parametrize(
    ("at_s", "slack_s", "found"),
    [(0.49, 0, []), (0.5, 0, ["a"]), (0.55, 0.1, []), (0.61, 0.1, ["a"])],
)
def test_a_velocity_needs_a_young_message(at_s, slack_s, found):
    dead_man = HeldDeadMan(0.5, PAD.holds, slack_s)
    assert letters([drive(0.0), Twist(at_s, STICK)], dead_man) == found


def test_a_release_or_a_bad_message_ends_it_and_zero_is_always_well():
    for last in (released(0.1), Joy(0.1, "ada", (), ())):
        dead_man = HeldDeadMan(0.5, PAD.holds)
        events = [Twist(0.0, ZERO), drive(0.05), last, Twist(0.1, ZERO), Twist(0.11, STICK)]
        assert letters(events, dead_man) == ["a"]
    assert letters([drive(0), Twist(9, STICK)], HeldDeadMan(0, PAD.holds)) == []


def test_what_was_heard_before_a_suspension_or_settles_does_not_count():
    loss = Loss(0.1, "joy2twist", settles_s=0.25)
    for joy_s, found in ((0.05, ["a"]), (0.3, ["a"]), (0.36, [])):
        dead_man = HeldDeadMan(0.5, PAD.holds)
        assert letters([drive(joy_s), loss, Twist(0.37, STICK)], dead_man) == found


@pytest.mark.parametrize(
    ("before", "found"),
    [
        ([], ["b"]),
        ([drive(0.9)], ["b"]),
        ([released(0.9)], []),
        ([released(0.9), drive(0.95)], []),
        ([released(0.3), drive(0.9)], ["b"]),  # silence between
        ([released(0.9), drive(0.95, "bob")], ["b"]),
        ([released(0.9), Loss(0.95, "cable")], ["b"]),
        ([Loss(0.8, "joy2twist", settles_s=0.25), released(0.9)], ["b"]),
        ([released(0.9), Joy(0.95, "bob", (), ())], []),  # nobody drives by that
    ],
)
def test_nothing_moves_before_all_was_seen_released(before, found):
    rule = SeenReleased(0.5, PAD.is_good, PAD.is_released)
    assert letters([*before, Twist(1.0, STICK), Twist(1.0, ZERO)], rule) == found


def test_a_watcher_from_the_side_allows_for_the_way_of_the_messages():
    rule = SeenReleased(0.5, PAD.is_good, PAD.is_released, slack_s=0.1)
    events = [released(0.0), Loss(0.2, "cable"), Twist(0.29, STICK), Twist(0.31, STICK)]
    assert [violation.at_s for violation in judged(events, rule)] == [0.31]


def test_velocities_are_finite_and_within_the_limits():
    limits = WithinLimits(0.7, 3.0)
    well = [Twist(0, (0.7, 0, 0, 0, 0, -3.0)), Through(0, "", ZERO), Wheels(0, -0.7, 3.0)]
    assert letters(well, limits) == []
    bad = [
        Twist(0, (0.6, 0.6, 0, 0, 0, 0)), Twist(0, (0, 0, 0, 0, 0, 3.1)), Wheels(0, 0.71, 0),
        Through(0, "", (math.nan, 0, 0, 0, 0, 0)), Wheels(0, 0, math.inf),
    ]  # fmt: skip
    assert letters(bad, limits) == ["c"] * 5


def test_the_time_to_rest_is_measured_and_held_against_the_limit():
    rest = SoonAtRest(0.62)
    stops = [Loss(1.0, "joy_node"), Wheels(1.5, 0.2, 0), Wheels(1.6, 0, 0), Wheels(2.0, 0.2, 0)]
    assert letters(stops, rest) == []
    assert rest.worst_s == pytest.approx(0.6)
    turns_on = [Loss(3.0, "mux"), Wheels(3.6, 0, 0.1), Wheels(3.63, 0, 0.1), Wheels(4.0, 0, 0.1)]
    assert letters(turns_on, rest) == ["d"]
    assert rest.worst_s == pytest.approx(0.63)


def test_only_the_highest_that_speaks_drives():
    rule = HighestSpeaks({"stick": (7, 0.5), "program": (5, 1.0)})
    well = [
        Command(0.0, "stick", STICK), Through(0.0, "stick", STICK),
        Command(0.4, "stick", (math.nan,) * 6), Through(0.5, "program", STICK),
    ]  # fmt: skip
    assert letters(well, rule) == []
    bad = [Command(1.0, "stick", ZERO), Through(1.49, "program", STICK)]
    assert letters(bad, rule) == ["e"]


def test_a_sender_that_was_silent_in_a_motion_rests_first():
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
    assert is_late(1.0, 1.6, 0.5) and not is_late(1.0, 1.4, 0.5)


def test_a_node_ends_when_told_to():
    ended_s = {"soon": 1.5, "late": 9.0, "never": None}
    texts = [violation.what for violation in unended(1.0, ended_s, 2.0)]
    assert texts == ["late did not end within 2.0 s", "never did not end within 2.0 s"]


def test_a_robot_goes_on_whatever_happens_to_another():
    well = [Wheels(0.0, 0.2, 0, "ada"), Wheels(0.1, 0, 0, "bob"), Wheels(0.2, 0.2, 0, "ada")]
    assert letters(well, GoesOn("ada", 0.5, drives=True)) == []
    assert letters([*well, Wheels(0.3, 0, 0, "ada")], GoesOn("ada", 0.5, True)) == ["h"]
    assert letters([*well, Wheels(0.9, 0.2, 0, "ada")], GoesOn("ada", 0.5, True)) == ["h"]
    assert letters(well, GoesOn("bob", 0.5, drives=False)) == []
    assert letters([*well, Wheels(0.3, 0.1, 0, "bob")], GoesOn("bob", 0.5, False)) == ["h"]
