"""Which input drives: what each publishes when, which is active then, what goes through."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.mux.arbitration import IDLE, REARM_S, Arbiter, Verdict, admits
from fake_turtlebot_sim.mux.parameters import Input
from node_kit.arming import Arming

SAFETY = Input("safety", "input/safety", 0.2, 10)
TELEOP = Input("teleop", "input/teleop", 1.0, 7)
NAVI = Input("navi", "input/navi", 1.0, 5)
INPUTS = (NAVI, SAFETY, TELEOP)  # their order means nothing

THROUGH, DROPPED = Verdict.OBEYED, Verdict.OUTRANKED
STOP = "stop"  # a zero of the mux's own is due

# Title: lines of (time [s], input, forward velocity, what becomes of it, active input).
STORIES = {
    "one input drives, falls silent, and the robot is stopped once": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.9, "navi", 0.1, THROUGH, "navi"),
        (1.8, None, None, None, "navi"),
        (1.9, None, None, STOP, IDLE),
        (2.0, None, None, None, IDLE),
    ],
    "an input that fell silent while it was outranked is not fallen back to": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.5, "teleop", 0.2, THROUGH, "teleop"),
        (1.4, "teleop", 0.2, THROUGH, "teleop"),
        (2.3, None, None, None, "teleop"),
        (2.4, None, None, STOP, IDLE),
    ],
    "after the last fall-back the stop of the robot still comes": [
        (0.0, "safety", -0.1, THROUGH, "safety"),
        (0.1, "navi", 0.1, DROPPED, "safety"),
        (0.2, None, None, None, "navi"),
        (1.1, None, None, STOP, IDLE),
    ],
    "a command that is not finite neither goes through nor keeps an input active": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.9, "navi", nan, Verdict.REJECTED, "navi"),
        (1.0, "navi", inf, Verdict.REJECTED, IDLE),
        (1.0, None, None, STOP, IDLE),
        (1.1, "teleop", -inf, Verdict.REJECTED, IDLE),
        (1.2, "navi", 0.1, THROUGH, "navi"),
    ],
}


@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES)
def test_who_drives(story):
    arbiter = Arbiter(INPUTS)
    for now, speaker, speed, outcome, active in story:
        if speaker:
            velocity = (speed, 0.0, 0.0, 0.0, 0.0, 0.0)
            assert arbiter.command(speaker, velocity, now) is outcome, now
        else:
            assert arbiter.must_stop(now) is (outcome is STOP), now
        assert arbiter.active(now) == active, now


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_each_of_the_six_numbers_must_be_finite(place, bad):
    velocity = [0.0] * 6
    velocity[place] = bad
    assert Arbiter(INPUTS).command("navi", velocity, 0.0) is Verdict.REJECTED


def test_nobody_is_noticed_late():
    arbiter = Arbiter(INPUTS)
    assert arbiter.lull(0.0) == 0.2  # nobody speaks: but safety may begin now
    arbiter.command("navi", (0.1,), 0.0)
    assert arbiter.lull(0.5) == 0.2
    assert arbiter.lull(0.875) == 0.125


TIMES = st.floats(0.0, 2.0, exclude_min=True)
SPEEDS = st.sampled_from([0.0, 0.1, -0.1])
NAMES = st.sampled_from([one.name for one in INPUTS])


@given(st.lists(st.tuples(TIMES, NAMES, SPEEDS)))
def test_who_drives_follows_from_who_spoke_when(events):
    arbiter, now, spoke_s = Arbiter(INPUTS), 0.0, {}
    for pause_s, name, speed in events:
        now += pause_s
        spoke_s[name] = now
        verdict = arbiter.command(name, (speed,), now)
        active = [one for one in INPUTS if now < spoke_s.get(one.name, -inf) + one.timeout]
        expected = max(active, key=lambda one: one.priority).name
        assert arbiter.active(now) == expected
        assert (verdict is THROUGH) == (expected == name)


@given(st.lists(st.tuples(TIMES, NAMES, SPEEDS)))
def test_silence_of_all_leaves_the_robot_standing(events):
    arbiter, now, last = Arbiter(INPUTS), 0.0, 0.0
    for pause_s, name, speed in events:
        now += pause_s
        if arbiter.command(name, (speed,), now) is THROUGH:
            last = speed
    assert arbiter.must_stop(now + 1.0) is (last != 0.0)
    assert not arbiter.must_stop(now + 1.0)


# The same for one sender whose commands may be late: lines of (time [s], velocity, may it move).
LATE_STORIES = {
    "a network is restored: of the commands of meanwhile not one moves the robot": [
        (0.0, 0.2, True),
        (5.0, 0.2, False),
        (5.0, 0.3, False),
        (5.01, 0.3, False),
        (5.1, 0.3, False),  # this one is of now, but who can tell
    ],
    "a zero among the late commands does not set the rest of them free": [
        (0.0, 0.2, True),
        (5.0, 0.2, False),
        (5.0, 0.0, True),
        (5.0, 0.3, False),
        (5.001, 0.0, True),
        (5.002, 0.3, False),
    ],
    "after a rest it moves again": [
        (0.0, 0.2, True),
        (5.0, 0.2, False),
        (5.0, 0.0, True),
        (5.3, 0.0, True),
        (5.6, 0.2, True),
        (5.7, 0.2, True),
    ],
    "a rest that is too short is none, and begins anew": [
        (0.0, 0.2, True),
        (5.0, 0.0, True),
        (5.4, 0.2, False),
        (5.5, 0.0, True),
        (5.9, 0.2, False),
        (6.0, 0.0, True),
        (6.6, 0.2, True),
    ],
}


@pytest.mark.parametrize("story", LATE_STORIES.values(), ids=LATE_STORIES)
def test_late_commands(story):
    sender = Arming(rest_s=REARM_S)
    for now, speed, moves in story:
        assert admits(sender, (speed, 0.0), now) is moves, now


@given(st.lists(st.tuples(st.floats(0.0, 1.0), SPEEDS)))
def test_after_silence_in_a_motion_only_a_rest_sets_free(events):
    sender, now, held = Arming(rest_s=REARM_S), 0.0, False
    heard_s, speed_before, rest_s = -inf, 0.0, -inf  # rest_s: since when nothing but zero came
    for pause_s, speed in events:
        now += pause_s
        if speed_before and now - heard_s > REARM_S:
            held = True
        if speed and not speed_before and now - rest_s >= REARM_S:
            held = False
        assert admits(sender, (speed,), now) is not (held and speed != 0.0)
        if speed == 0.0 and speed_before:
            rest_s = now
        heard_s, speed_before = now, speed


@given(
    st.floats(REARM_S, 100.0, exclude_min=True), st.lists(st.tuples(st.floats(0.0, 0.49), SPEEDS))
)
def test_not_one_command_of_a_late_burst_moves(silence_s, burst):
    """Whatever is in the burst and however it is spread over half a second."""
    sender = Arming(rest_s=REARM_S)
    admits(sender, (0.2,), 0.0)
    late = [(silence_s + after_s, speed) for after_s, speed in sorted(burst)]
    assert not any(admits(sender, (speed,), now) and speed for now, speed in late)


def test_only_inputs_that_ask_for_it_must_rearm():
    teleop = Input("teleop", "input/teleop", 1.0, 7, rearm_on_zero=True)
    arbiter = Arbiter([teleop, NAVI])
    for name, verdict in (("navi", THROUGH), ("teleop", Verdict.LATE)):
        now = 10.0 * len(name)
        assert arbiter.command(name, (0.2,), now) is THROUGH
        assert arbiter.command(name, (0.2,), now + 5.0) is verdict
    # A late command keeps nobody active, and who is outranked is watched all the same.
    assert arbiter.active(now + 5.0) == IDLE


def test_what_one_sender_left_is_not_held_against_the_next():
    """Who ends a program in the middle of a motion and starts it anew drives at once."""
    arbiter = Arbiter([Input("teleop", "input/teleop", 1.0, 7, rearm_on_zero=True)])
    assert arbiter.command("teleop", (0.2,), 0.0, "/rostopic_1") is THROUGH
    assert arbiter.command("teleop", (0.2,), 5.0, "/rostopic_2") is THROUGH
    assert arbiter.command("teleop", (0.2,), 5.1, "/rostopic_1") is Verdict.LATE


@pytest.mark.parametrize("rested_before", [True, False])
def test_after_the_robot_was_lost_a_sender_moves_it_only_after_a_rest(rested_before):
    arbiter = Arbiter([Input("teleop", "input/teleop", 1.0, 7, rearm_on_zero=True), NAVI])
    for name in ("teleop", "navi"):
        arbiter.command(name, (0.0 if rested_before else 0.2,), 0.0)
    arbiter.lost()
    assert arbiter.command("teleop", (0.2,), 0.4) is Verdict.LATE
    assert arbiter.command("teleop", (0.2,), 5.0) is Verdict.LATE  # silence is no rest
    assert arbiter.command("teleop", (0.0,), 5.1) is THROUGH
    assert arbiter.command("teleop", (0.2,), 5.1 + 0.99 * REARM_S) is Verdict.LATE
    assert arbiter.command("teleop", (0.0,), 6.0) is THROUGH
    assert arbiter.command("teleop", (0.2,), 6.0 + 1.01 * REARM_S) is THROUGH
    # Who drives by itself, and not by a stick that is held, goes on.
    assert arbiter.command("navi", (0.1,), 100.0) is THROUGH
