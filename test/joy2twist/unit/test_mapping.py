"""From axes and buttons to a velocity, compared with the C++ node teleop_twist_joy."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from joy_to_twist.mapping import BadJoyError, Mapping, approach, limit_speed
from joy_to_twist.parameters import load
from node_kit.rules.arming import ZERO
from tutorial_testing.claims import claim

AXES = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
PAD = {"enable_button": 0, "enable_turbo_button": 1}
DIFFERENTIAL = {**PAD, "scale_linear": 1.0, "scale_linear_turbo": 2.0, "scale_angular": 3.0}
SIX_AXES = {
    "axis_linear": {"x": 1, "y": 2, "z": 3},
    "scale_linear": {"x": 1.0, "y": 4.0, "z": 2.0},
    "axis_angular": {"roll": 4, "pitch": 5, "yaw": 0},
    "scale_angular": {"roll": 3.0, "pitch": 2.0, "yaw": 1.0},
    "enable_button": 0,
}
NOT_REQUIRED = {**DIFFERENTIAL, "require_enable_button": False}
TURBO = {"enable_turbo_button": 0, "require_enable_button": True}
TURBO_MAP = {**SIX_AXES, "enable_turbo_button": 1, "scale_linear_turbo": {"x": 2.0, "y": 8.0}}
CAR = {"inverted_reverse": True}


@claim("The tutorial's node: each ...", because="every axis and button")
@pytest.mark.parametrize(("about", "given", "axes", "buttons", "expected"), [
    ("tutorial", {}, AXES[:2], (), (0.4, 0, 0, 0, 0, 0.3)),
    ("differential", DIFFERENTIAL, AXES, (1, 0), (0.4, 0, 0, 0, 0, 0.9)),
    ("six axes", SIX_AXES, AXES, (1,), (0.4, 2.0, 1.2, 2.1, 1.6, 0.3)),
    ("not enabled", DIFFERENTIAL, AXES, (0, 0), None),
    ("turbo over enable", DIFFERENTIAL, AXES, (1, 1), (0.8, 0, 0, 0, 0, 0.9)),
    ("angular turbo", {**DIFFERENTIAL, "scale_angular_turbo": 5.0}, AXES, (0, 1),
     (0.8, 0, 0, 0, 0, 1.5)),
    ("turbo from a map", TURBO_MAP, AXES, (0, 1), (0.8, 4.0, 1.2, 2.1, 1.6, 0.3)),
    ("enable not required, turbo", NOT_REQUIRED, AXES, (0, 1), (0.8, 0, 0, 0, 0, 0.9)),
    # As in teleop_twist_joy, a button that the gamepad lacks is not pressed.
    ("no turbo button", DIFFERENTIAL, AXES, (1,), (0.4, 0, 0, 0, 0, 0.9)),
    ("no turbo button, not held", DIFFERENTIAL, AXES, (0,), None),
    ("turbo is the only dead-man, and button 0", TURBO, AXES, (1, 0), (0.4, 0, 0, 0, 0, 0.3)),
    ("no other button drives then", TURBO, AXES, (0, 1), None),
    ("on the spot", CAR, (0.3, 0.0), (), (0, 0, 0, 0, 0, 0.3)),
    ("like a car", CAR, (0.3, -0.4), (), (-0.4, 0, 0, 0, 0, -0.3)),
    ("a car goes ahead", CAR, (0.3, 0.4), (), (0.4, 0, 0, 0, 0, 0.3)),
    ("a curve", {"axis_curve": 2.0}, (0.3, -0.4), (), (-0.16, 0, 0, 0, 0, 0.09)),
    ("no linear axis", {"axis_linear": -1}, (0.5, 0.4), (), (0, 0, 0, 0, 0, 0.5)),
    ("as far as it goes", {"max_linear_speed": 2.0}, (0.0, 1e6), (), (2.0, 0, 0, 0, 0, 0)),
    ("no axis at all", {"axis_linear": -1, "axis_angular": -1}, (), (), ZERO),
])  # fmt: skip
def test_axes_and_buttons_give_a_velocity_or_none(about, given, axes, buttons, expected):
    velocity = Mapping(load(given)).velocity(axes, buttons)
    assert velocity == (None if expected is None else pytest.approx(expected)), about


@pytest.mark.parametrize(("given", "axes", "buttons", "words"), [
    ({}, (0.5,), (), "no axis 1 (-> linear.x): it has 1 axes"),
    ({"axis_linear": 9}, AXES, (), "no axis 9 (-> linear.x): it has 6 axes"),
    (PAD, AXES, (), "no button 0 (~enable_button): it has 0 buttons"),
    ({}, (0.0, 0.1, float("nan")), (), "nan"),
    ({}, (float("inf"), float("-inf")), (), "inf"),
    ({}, (0.0, 1e6 + 0.5), (), "1000000.5"),
])  # fmt: skip
def test_a_bad_message_is_named(given, axes, buttons, words):
    with pytest.raises(BadJoyError) as error:
        Mapping(load(given)).velocity(axes, buttons)
    assert words in str(error.value)


@pytest.mark.parametrize(("given", "axes", "buttons", "rests"), [
    ({}, (0.05, -0.1, 1.0, -1.0), (0,), True),  # triggers that rest at an end are not in use
    ({}, (0.0, 0.11, 0.0, 0.0), (0,), False),
    ({"enable_button": 0}, (0.0, 0.0), (1,), False),
])  # fmt: skip
def test_a_rest_is_released_sticks_in_use_and_a_released_dead_man(given, axes, buttons, rests):
    mapping = Mapping(load(given))
    assert mapping.released(axes, mapping.velocity(axes, buttons)) is rests


def test_the_stop_button_counts_in_a_message_that_is_cut_and_wins_over_reset():
    mapping = Mapping(load({"stop_button": 1, "stop_reset_button": 2}))
    assert [mapping.stops(held) for held in ((0, 1), (0,), (), (0, 0, 1))] == [True] + [False] * 3
    assert [mapping.resets(held) for held in ((0, 0, 1), (0, 1, 1))] == [True, False]
    assert not Mapping(load({})).stops((1, 1, 1))


@pytest.mark.parametrize(("given", "line", "deadman"), [
    ({}, "axis 1 -> linear.x at 1 m/s; no dead-man button", "none"),
    ({"enable_button": 0}, "axis 1 -> linear.x at 1 m/s; hold button 0", "0"),
    (TURBO, "axis 0 -> angular.z at 1 rad/s (turbo: 1 rad/s); hold button 0 for turbo", "0"),
    ({"enable_button": 4, "enable_turbo_button": 5, "scale_linear": 0.7},
     "axis 1 -> linear.x at 0.7 m/s (turbo: 1 m/s); hold button 4, or 5 for turbo", "4"),
    ({"stop_button": 0, "stop_reset_button": 2}, "button 0 stops, until button 2", "none"),
    ({"vigilance_timeout": 3.0, "arm_on_neutral": True},
     "no change of the joystick for 3 s stops the robot", "none"),
    ({"arm_on_neutral": True},
     "nothing moves before the sticks and the dead-man button are released", "none"),
    ({"joy_timeout": 0.5}, "no message of the joystick for 0.5 s stops the robot", "none"),
])  # fmt: skip
def test_the_mapping_in_words(given, line, deadman):
    mapping = Mapping(load(given))
    assert line in mapping.describe() and ("until" in line) == ("until" in str(mapping.describe()))
    assert mapping.deadman == deadman


velocities = st.tuples(*[st.floats(-1e9, 1e9)] * 6)


@given(velocities, st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_limited_speed_is_within_the_limits_and_keeps_its_direction(velocity, linear, angular):
    assert limit_speed(velocity, math.hypot(*velocity[:3]), math.hypot(*velocity[3:])) == velocity
    limited = limit_speed(velocity, linear, angular)
    for part, limit in ((slice(3), linear), (slice(3, 6), angular)):
        length, before = math.hypot(*limited[part]), math.hypot(*velocity[part])
        assert length <= limit * (1 + 1e-12)
        assert before <= limit or length == pytest.approx(limit)
        for now, wanted in zip(limited[part], velocity[part]):
            assert now * before == pytest.approx(wanted * length, rel=1e-9)


@given(st.tuples(*[st.floats(-2, 2)] * 6), st.tuples(*[st.floats(-2, 2)] * 6))
def test_the_target_is_reached_exactly_in_the_time_it_takes(start, target):
    velocity = start
    for _ in range(80):  # at most 2 * sqrt(3) * 2 apart, 0.1 per step
        velocity = approach(velocity, target, 0.1, 0.1)
    assert velocity == target
