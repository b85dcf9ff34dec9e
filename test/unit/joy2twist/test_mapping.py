"""From axes and buttons to a velocity, held against the C++ node teleop_twist_joy."""

import pytest

from joy_to_twist.mapping import BadJoyError, Mapping
from joy_to_twist.parameters import load
from node_kit.arming import ZERO

AXES = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
PAD = {"enable_button": 0, "enable_turbo_button": 1}
DIFFERENTIAL = {**PAD, "scale_linear": 1.0, "scale_linear_turbo": 2.0, "scale_angular": 3.0}
HOLONOMIC = {
    "axis_linear": {"x": 1, "y": 2},
    "scale_linear": {"x": 1.0, "y": 4.0},
    "axis_angular": 0,
    "scale_angular": 3.0,
    "enable_button": 0,
}
SIX_AXES = {
    "axis_linear": {"x": 1, "y": 2, "z": 3},
    "scale_linear": {"x": 1.0, "y": 4.0, "z": 2.0},
    "axis_angular": {"roll": 4, "pitch": 5, "yaw": 0},
    "scale_angular": {"roll": 3.0, "pitch": 2.0, "yaw": 1.0},
    "enable_button": 0,
}


@pytest.mark.parametrize(
    ("given", "axes", "buttons", "expected"),
    [
        pytest.param({}, AXES[:2], (), (0.4, 0, 0, 0, 0, 0.3), id="tutorial"),
        pytest.param(DIFFERENTIAL, AXES, (1, 0), (0.4, 0, 0, 0, 0, 0.9), id="differential"),
        pytest.param(HOLONOMIC, AXES, (1,), (0.4, 2.0, 0, 0, 0, 0.9), id="holonomic"),
        pytest.param(SIX_AXES, AXES, (1,), (0.4, 2.0, 1.2, 2.1, 1.6, 0.3), id="six axes"),
        pytest.param(DIFFERENTIAL, AXES, (0, 0), None, id="not enabled"),
        pytest.param(DIFFERENTIAL, AXES, (0, 1), (0.8, 0, 0, 0, 0, 0.9), id="only turbo"),
        pytest.param(DIFFERENTIAL, AXES, (1, 1), (0.8, 0, 0, 0, 0, 0.9), id="turbo over enable"),
        pytest.param(
            {**DIFFERENTIAL, "scale_angular_turbo": 5.0},
            AXES,
            (0, 1),
            (0.8, 0, 0, 0, 0, 1.5),
            id="angular turbo",
        ),
        pytest.param(
            {"enable_button": 0, "scale_linear": 0.5, "enable_turbo_button": 1},
            AXES,
            (0, 1),
            (0.4, 0, 0, 0, 0, 0.3),
            id="turbo is 1 unless given",
        ),
        pytest.param(
            {**HOLONOMIC, "enable_turbo_button": 1, "scale_linear_turbo": {"x": 2.0, "y": 8.0}},
            AXES,
            (0, 1),
            (0.8, 4.0, 0, 0, 0, 0.9),
            id="turbo from a map",
        ),
        pytest.param(
            {**DIFFERENTIAL, "require_enable_button": False},
            AXES,
            (0, 0),
            (0.4, 0, 0, 0, 0, 0.9),
            id="enable not required",
        ),
        pytest.param(
            {**DIFFERENTIAL, "require_enable_button": False},
            AXES,
            (0, 1),
            (0.8, 0, 0, 0, 0, 0.9),
            id="enable not required, turbo",
        ),
        pytest.param(
            {"enable_turbo_button": 1, "require_enable_button": True},
            AXES,
            (1, 0),
            None,
            id="turbo is the only dead-man",
        ),
        pytest.param(
            {"enable_turbo_button": 0, "require_enable_button": True},
            AXES,
            (1, 0),
            (0.4, 0, 0, 0, 0, 0.3),
            id="turbo is button 0",
        ),
        pytest.param(
            {"enable_turbo_button": 0, "require_enable_button": True},
            AXES,
            (0, 1),
            None,
            id="and no other drives, as the last does not",
        ),
        pytest.param({}, (0.3, -0.4), (), (-0.4, 0, 0, 0, 0, 0.3), id="reverse"),
        pytest.param(
            {"inverted_reverse": True}, (0.3, 0.4), (), (0.4, 0, 0, 0, 0, 0.3), id="forward"
        ),
        pytest.param(
            {"inverted_reverse": True}, (0.3, 0.0), (), (0, 0, 0, 0, 0, 0.3), id="on the spot"
        ),
        pytest.param(
            {"inverted_reverse": True}, (0.3, -0.4), (), (-0.4, 0, 0, 0, 0, -0.3), id="like a car"
        ),
        pytest.param(
            {"axis_linear": -1}, (0.5, 0.4), (), (0, 0, 0, 0, 0, 0.5), id="no linear axis"
        ),
    ],
)
def test_velocity(given, axes, buttons, expected):
    velocity = Mapping(load(given)).velocity(axes, buttons)
    assert velocity == (None if expected is None else pytest.approx(expected))


def test_speed_limits_hold_for_the_length_of_the_vector():
    given = {**HOLONOMIC, "max_linear_speed": 0.5, "max_angular_speed": 0.2}
    mapping = Mapping(load(given))
    # (0.6, 0.2 * 4) has the length 1: halved.
    assert mapping.velocity((0.1, 0.6, 0.2), (1,)) == pytest.approx((0.3, 0.4, 0, 0, 0, 0.2))
    assert mapping.velocity((0.05, 0.1, 0.0), (1,)) == pytest.approx((0.1, 0, 0, 0, 0, 0.15))


@pytest.mark.parametrize(
    ("given", "axes", "buttons", "words"),
    [
        ({}, (0.5,), (), "no axis 1 (-> linear.x): it has 1 axes"),
        ({}, (), (), "no axis"),
        ({"axis_linear": 9}, AXES, (), "no axis 9 (-> linear.x): it has 6 axes"),
        (PAD, AXES, (1,), "no button 1 (~enable_turbo_button): it has 1 buttons"),
        ({}, (0.0, float("nan")), (), "nan"),
        ({}, (0.0, 0.1, float("nan")), (), "nan"),
        ({}, (float("inf"), float("-inf")), (), "inf"),
        ({}, (0.0, 3e38), (), "3e+38"),
    ],
)
def test_a_bad_message_is_named(given, axes, buttons, words):
    with pytest.raises(BadJoyError) as error:
        Mapping(load(given)).velocity(axes, buttons)
    assert words in str(error.value)


def test_the_largest_value_that_is_no_noise():
    mapping = Mapping(load({}))
    assert mapping.velocity((0.0, -1e6), ()) == (-1e6, 0, 0, 0, 0, 0)
    with pytest.raises(BadJoyError):
        mapping.velocity((0.0, 1e6 + 0.5), ())


def test_a_rest_looks_only_at_the_axes_in_use():
    mapping = Mapping(load({}))
    assert mapping.rests((0.05, -0.1, 1.0, -1.0), (0,) * 6)  # triggers rest at the end
    assert not mapping.rests((0.0, 0.11, 0.0, 0.0), (0,) * 6)
    assert not mapping.rests((-0.2, 0.0, 0.0, 0.0), (0,) * 6)


def test_a_rest_needs_a_released_dead_man():
    mapping = Mapping(load({"enable_button": 0}))
    assert mapping.rests((0.0, 0.0), mapping.velocity((0.0, 0.0), (0,)))
    assert not mapping.rests((0.0, 0.0), mapping.velocity((0.0, 0.0), (1,)))


@pytest.mark.parametrize(
    ("curve", "axis", "speed"),
    [(1, 0.5, 0.5), (2, 0.5, 0.25), (2, -0.5, -0.25), (3, 0.5, 0.125), (3, 1.0, 1.0), (2, 0, 0)],
)
def test_a_curve_is_gentle_near_the_middle_and_keeps_the_ends(curve, axis, speed):
    mapping = Mapping(load({"axis_curve": curve}))
    assert mapping.velocity((-axis, axis), ()) == (speed, 0, 0, 0, 0, -speed)


def test_the_stop_button_counts_in_a_message_that_is_cut_and_wins_over_reset():
    mapping = Mapping(load({"stop_button": 1, "stop_reset_button": 2}))
    assert mapping.stops((0, 1))
    assert not mapping.stops((0,))
    assert not mapping.stops((0, 0, 1))
    assert mapping.resets((0, 0, 1))
    assert not mapping.resets((0, 1, 1))
    assert not Mapping(load({})).stops((1, 1, 1))


def test_the_mapping_in_words():
    assert Mapping(load({})).describe() == [
        "axis 1 -> linear.x at 1 m/s; no dead-man button",
        "axis 0 -> angular.z at 1 rad/s; no dead-man button",
    ]
    given = {"scale_linear": 0.7, "axis_angular": -1, "enable_button": 4}
    assert Mapping(load(given)).describe() == ["axis 1 -> linear.x at 0.7 m/s; hold button 4"]
    given["enable_turbo_button"] = 5
    assert Mapping(load(given)).describe() == [
        "axis 1 -> linear.x at 0.7 m/s (turbo: 1 m/s); hold button 4, or 5 for turbo"
    ]
    given["require_enable_button"] = False
    assert Mapping(load(given)).describe()[0].endswith("; hold button 5 for turbo")
    given.update(require_enable_button=True, enable_button=-1)
    assert Mapping(load(given)).describe()[0].endswith("; hold button 5 for turbo")
    assert "no axis drives" in Mapping(load({"axis_linear": -1, "axis_angular": -1})).describe()[0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"enable_turbo_button": 0, "require_enable_button": False}, "; hold button 0 for turbo"),
        ({"enable_turbo_button": 0, "require_enable_button": True}, "; hold button 0 for turbo"),
        ({"enable_button": 0}, "; hold button 0"),
        (
            {"enable_button": 1, "enable_turbo_button": 0},
            "(turbo: 1 m/s); hold button 1, or 0",
        ),
    ],
)
def test_button_0_is_a_button(given, words):
    assert words in Mapping(load(given)).describe()[0]


def test_where_no_axis_drives_none_is_asked_for():
    mapping = Mapping(load({"axis_linear": -1, "axis_angular": -1}))
    assert mapping.velocity((), ()) == ZERO
