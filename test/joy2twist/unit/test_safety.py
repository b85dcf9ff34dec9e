"""When to send a velocity, zero or nothing. Times are simulated, in seconds.

Arming, losses and lateness: random messages and parameters in test/suite/unit/test_stateful.py.
"""

from math import inf

import pytest

from joy_to_twist.parameters import load
from joy_to_twist.safety import Safety
from joy_to_twist.states import Notice, State
from node_kit.rules.arming import ZERO
from tutorial_testing.claims import claim
from tutorial_testing.over_time import over_time

pytestmark = claim("Dead-man button, timeout ...", because="every rule at its limit")
S = State
FORWARD = (0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
BACKWARD = (-0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
DEAD_MAN = {"enable_button": 4}
ARMS = {**DEAD_MAN, "arm_on_neutral": True, "stop_messages": 1}
LIMITS = {"max_linear_acceleration": 1.0, "output_rate": 10.0}  # 0.1 m/s in each period


def safety(**given):
    return Safety(load({"joy_timeout": 0.5, **given}), wake=lambda: None)


# Events by name. A stick may be pushed while the dead-man button is released.
ACTS = {
    "forward": lambda machine, now: machine.drive(FORWARD, False, now),
    "backward": lambda machine, now: machine.drive(BACKWARD, False, now),
    "middle": lambda machine, now: machine.drive(ZERO, True, now),
    "release": lambda machine, now: machine.drive(None, True, now),
    "pushed": lambda machine, now: machine.drive(None, False, now),
    "bad": lambda machine, now: machine.reject(now),
    "leaves": lambda machine, now: machine.lost(S.LEFT, now),
    "bob forward": lambda machine, now: machine.drive(FORWARD, False, now, "bob"),
}
# Name: parameters, then (time, event, what is sent at once, the state if it matters).
STORIES = {
    "without a dead-man every message drives": ({}, [
        (0.0, "forward", FORWARD, S.DRIVING), (0.02, "backward", BACKWARD), (0.04, "middle", ZERO),
        (0.06, "bob forward", FORWARD), (0.08, "forward", FORWARD)]),
    "a bad message is answered by one zero": ({}, [
        (0.0, "forward", FORWARD), (0.02, "bad", ZERO, S.BAD_MESSAGE), (0.03, "bad", ZERO),
        (0.4, "forward", FORWARD)]),
    "a joystick node that left is silence": ({"joy_timeout": 0, "stop_messages": 1}, [
        (0.0, "leaves", None, S.WAITING), (1.0, "forward", FORWARD), (1.1, "leaves", ZERO, S.LEFT),
        (1.2, "leaves", None, S.LEFT)]),
    "a released dead-man stops, also in the first message": (DEAD_MAN, [
        (0.0, "release", ZERO, S.ARMED), (0.1, "forward", FORWARD, S.DRIVING),
        (0.12, "pushed", ZERO)]),
}  # fmt: skip


@pytest.mark.parametrize("name", STORIES)
def test_what_is_sent_at_once_and_the_state(name):
    given, steps = STORIES[name]
    machine = safety(**given)
    assert machine.state == S.WAITING
    for now, act, sent, *state in steps:
        assert ACTS[act](machine, now) == sent, now
        assert [machine.state] == state or not state, now


@pytest.mark.parametrize(("given", "acts", "sent"), [
    ({}, ["forward"], [(t, ZERO) for t in (0.5, 0.55, 0.6, 0.65, 0.7)]),
    ({"joy_timeout": 0}, ["forward"], []),
    ({}, ["middle"], []),  # a robot at rest needs no stop, unless it is only passing through zero
    ({"stop_messages": 1, "joy_timeout": 0.15, **LIMITS}, ["forward", "backward"],
     [(0.1, ZERO), (0.15, ZERO)]),
    ({"stop_messages": 3, "output_rate": 10, **DEAD_MAN}, ["forward", "release"],
     [(0.1, ZERO), (0.2, ZERO)]),
    ({"stop_messages": 2, **DEAD_MAN}, ["forward", "bad"], [(0.05, ZERO)]),
])  # fmt: skip
def test_what_silence_sends(given, acts, sent):
    machine = safety(**given)
    for act in acts:
        ACTS[act](machine, 0.0)
    assert over_time(machine, 0.0, 10.0) == sent
    assert machine.due == inf


ADA, BOB = [], []  # equal, but not identical


@pytest.mark.parametrize(("given", "messages", "pause", "times", "notices"), [
    # Two senders in turn; a held stick that moves nothing; silence while the robot moves.
    ({}, [(None, True, ADA), (None, True, BOB)], 0.02, 200, [Notice.IN_TURN]),
    ({}, [(None, True, ADA), (None, True, BOB)], 1.0, 200, []),
    ({}, [(None, True, ADA), (None, True, BOB)], 0.999, 200, [Notice.IN_TURN] * 34),
    ({}, [(FORWARD, False), (None, False), (ZERO, False)], 0.02, 400, [Notice.NOT_ARMED] * 2),
    *[({"arm_on_neutral": False, "joy_timeout": 0.5}, [(sent, False)], 0.5, 1, notices)
      for sent, notices in ((FORWARD, [Notice.SILENT]), (BACKWARD, [Notice.SILENT]), (ZERO, []))
    ],
])  # fmt: skip
def test_what_is_wrong_is_named_now_and_then(given, messages, pause, times, notices):
    warnings = []
    machine = Safety(load({**ARMS, **given}), lambda: None, warnings.append)
    for i in range(times):
        velocity, rests, *sender = messages[i % len(messages)]
        machine.drive(velocity, rests, 100.0 + i * pause, *sender)
    machine.tick(100.0 + times * pause)
    assert warnings == notices


def test_a_joystick_that_leaves_a_moving_robot_is_named():
    warnings = []
    machine = Safety(load({}), lambda: None, warnings.append)
    for velocity in (FORWARD, ZERO):
        machine.drive(velocity, False, 0.0)
        machine.lost(State.LEFT, 0.0)
    assert warnings == [Notice.LEFT]


@claim("A gamepad out ...", because="a gamepad out of reach")
def test_a_held_joystick_that_is_silent_is_stopped_as_one_that_does_not_change():
    machine = safety(**{**ARMS, "joy_timeout": 0, "vigilance_timeout": 1.0})
    sent = [ACTS["release"](machine, 0.0), ACTS["forward"](machine, 0.0), machine.tick(0.9)]
    assert [*sent, machine.tick(1.0)] == [ZERO, FORWARD, None, ZERO]


def test_the_node_is_woken_where_something_is_due_sooner():
    woken = []
    machine = Safety(load({}), lambda: woken.append(True))
    # Silence counts from the first message on, stillness only while the robot moves.
    for act, count in (("forward", 2), ("backward", 2), ("forward", 2), ("middle", 2),
                       ("backward", 3), ("forward", 3), ("backward", 3)):  # fmt: skip
        ACTS[act](machine, 0.0)
        assert len(woken) == count


def hold(machine, speed, start, end):
    """Send a message every 0.05 s; return what drive() and tick() send."""
    sent = []
    for i in range(round((end - start) / 0.05)):
        now = start + i * 0.05
        answer = machine.drive((speed, 0, 0, 0, 0, 0), False, now)
        sent += [] if answer is None else [(round(now, 6), answer)]
        sent += over_time(machine, now, now + 0.05 - 1e-6)
    return [(t, round(velocity[0], 6)) for t, velocity in sent]


@pytest.mark.parametrize("sign", [1, -1])
def test_speed_comes_at_a_steady_rate_and_goes_with_the_stick(sign):
    machine = safety(**LIMITS)
    speeds = [(0.0, 0.1), (0.1, 0.2), (0.2, 0.25), (0.3, 0.25)]
    assert hold(machine, sign * 0.25, 0.0, 0.4) == [(t, sign * speed) for t, speed in speeds]
    # Released: a soft stop, then again one velocity for each message.
    speeds = [(0.4, 0.15), (0.5, 0.05), *((t, 0.0) for t in (0.6, 0.65, 0.7, 0.75))]
    assert hold(machine, 0.0, 0.4, 0.8) == [(t, sign * speed) for t, speed in speeds]


def test_each_part_has_a_limit_of_its_own():
    for limits, sent in (
        ({}, [(0.1, 0, 0, 0, 0, 1.0), (0.2, 0, 0, 0, 0, 1.0)]),
        ({"max_angular_acceleration": 2.0}, [(0.1, 0, 0, 0, 0, 0.2), (0.2, 0, 0, 0, 0, 0.4)]),
        ({"max_linear_acceleration": 0, "max_angular_acceleration": 0.5},
         [(0.5, 0, 0, 0, 0, 0.05), (0.5, 0, 0, 0, 0, 0.1)]),
    ):  # fmt: skip
        machine = safety(**{**LIMITS, **limits})
        assert [machine.drive((0.5, 0, 0, 0, 0, 1.0), False, 0.0), machine.tick(0.1)] == sent
