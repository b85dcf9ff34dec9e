"""Names, defaults and checks of the private parameters."""

from dataclasses import FrozenInstanceError

import pytest

from joy_to_twist.parameters import Axis, load

LINEAR_X, LINEAR_Y, LINEAR_Z, ROLL, PITCH, YAW = range(6)


def test_without_parameters_it_is_the_node_of_the_tutorial():
    p = load({})
    assert p.axes == (Axis(LINEAR_X, 1, 1.0, 1.0), Axis(YAW, 0, 1.0, 1.0))
    assert (p.enable_button, p.enable_turbo_button, p.require_enable_button) == (-1, -1, False)
    assert (p.joy_timeout, p.log_rate, p.arm_on_neutral) == (0.5, 50.0, False)


def test_numbers_stand_for_x_and_yaw():
    given = {"axis_linear": 4, "scale_linear": 0.7, "axis_angular": 3, "scale_angular": 0.4}
    assert load(given).axes == (Axis(LINEAR_X, 4, 0.7, 1.0), Axis(YAW, 3, 0.4, 0.4))


def test_maps_name_the_components():
    given = {
        "axis_linear": {"x": 1, "y": 2, "z": -1},
        "scale_linear": {"x": 0.7, "y": 0.5, "z": 9},
        "scale_linear_turbo": {"x": 1.5},
        "axis_angular": {"roll": 4, "pitch": 5, "yaw": 0},
        "scale_angular": {"roll": 3, "pitch": 2.0, "yaw": 1.0},
    }
    assert load(given).axes == (
        Axis(LINEAR_X, 1, 0.7, 1.5),
        Axis(LINEAR_Y, 2, 0.5, 0.5),
        Axis(ROLL, 4, 3.0, 3.0),
        Axis(PITCH, 5, 2.0, 2.0),
        Axis(YAW, 0, 1.0, 1.0),
    )


def test_a_scale_number_is_for_every_axis_of_a_map():
    axes = load({"axis_linear": {"x": 1, "y": 0}, "scale_linear": 0.3}).axes
    assert axes[:2] == (Axis(LINEAR_X, 1, 0.3, 0.3), Axis(LINEAR_Y, 0, 0.3, 0.3))


def test_a_scale_map_fits_an_axis_number():
    axes = load({"axis_linear": 2, "scale_linear": {"x": 0.6, "y": 0.5}}).axes
    assert axes[0] == Axis(LINEAR_X, 2, 0.6, 1.0)


@pytest.mark.parametrize(
    ("given", "required"),
    [
        ({"enable_button": 4}, True),
        ({"enable_button": 4, "enable_turbo_button": 5}, True),
        ({"enable_button": -1, "enable_turbo_button": 5}, False),
        ({"enable_turbo_button": 5, "require_enable_button": True}, True),
        ({"enable_button": 4, "require_enable_button": False}, False),
    ],
)
def test_a_named_enable_button_is_required_unless_said_otherwise(given, required):
    assert load(given).require_enable_button is required


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"axis_linear": "foo"}, ["~axis_linear", "'foo'", "number"]),
        ({"vigilance_timeout": 3.0}, ["~vigilance_timeout: 3: needs ~arm_on_neutral: true"]),
        ({"vigilance_timeout": 0.3, "arm_on_neutral": True}, ["from 1 to 60 s, or 0 for off"]),
        ({"vigilance_timeout": False}, ["~vigilance_timeout", "False"]),
        ({"stop_button": 1}, ["~stop_button: 1: needs ~stop_reset_button"]),
        ({"stop_reset_button": 1}, ["~stop_reset_button: 1: needs ~stop_button"]),
        ({"stop_button": 1, "stop_reset_button": 1}, ["other than ~stop_button"]),
        ({"stop_button": 4, "stop_reset_button": 1, "enable_button": 4}, ["than ~enable_button"]),
        ({"axis_curve": 0.5}, ["~axis_curve", "from 1 to 5"]),
        ({"axis_curve": "soft"}, ["~axis_curve", "'soft'"]),
        ({"axis_linear": 1.5}, ["~axis_linear", "1.5"]),
        ({"axis_linear": True}, ["~axis_linear", "True"]),
        ({"axis_linear": -2}, ["~axis_linear", "-2", "-1 for none"]),
        ({"axis_linear": {}}, ["~axis_linear", "{}", "x, y, z"]),
        ({"axis_linear": {"yaw": 1}}, ["~axis_linear", "yaw", "x, y, z"]),
        ({"axis_angular": {"x": 1}}, ["~axis_angular", "roll, pitch, yaw"]),
        ({"axis_angular": [0]}, ["~axis_angular", "[0]"]),
        ({"scale_linear": "fast"}, ["~scale_linear", "'fast'", "from -100 to 100"]),
        ({"scale_angular_turbo": -1e6}, ["~scale_angular_turbo", "from -100 to 100"]),
        ({"scale_linear": 100.5}, ["~scale_linear", "100.5"]),
        ({"scale_linear": {"x": 1.0, "y": "fast"}}, ["~scale_linear", "'fast'", "x, y, z"]),
        ({"axis_linear": {"x": 1, "y": None}}, ["~axis_linear", "None", "x, y, z"]),
        ({"scale_linear": -101}, ["~scale_linear", "-101", "from -100 to 100"]),
        ({"scale_angular": float("nan")}, ["~scale_angular", "nan"]),
        (
            {"axis_linear": {"x": 1, "y": 0}, "scale_linear": {"x": 1.0}},
            ["~scale_linear", "{'x': 1.0}", "y"],
        ),
        ({"enable_button": 1.0}, ["~enable_button", "1.0", "button number"]),
        ({"enable_button": -2}, ["~enable_button", "-2"]),
        ({"enable_button": 3, "enable_turbo_button": 3}, ["~enable_turbo_button", "3", "other"]),
        ({"require_enable_button": True}, ["~require_enable_button", "~enable_button"]),
        ({"require_enable_button": 1}, ["~require_enable_button", "true or false"]),
        ({"arm_on_neutral": "yes"}, ["~arm_on_neutral", "'yes'", "true or false"]),
        ({"joy_timeout": -0.1}, ["~joy_timeout", "-0.1", "0 to 60 s"]),
        ({"joy_timeout": float("inf")}, ["~joy_timeout", "inf"]),
        ({"joy_timeout": False}, ["~joy_timeout", "False"]),
        ({"max_joy_age": "1 s"}, ["~max_joy_age", "'1 s'"]),
        ({"output_rate": 0}, ["~output_rate", "0", "Hz"]),
        ({"stop_messages": 0}, ["~stop_messages", "0", "1 to 100"]),
        ({"stop_messages": 101}, ["~stop_messages", "101", "1 to 100"]),
        ({"stop_messages": 2.5}, ["~stop_messages", "2.5", "whole number"]),
        ({"output_rate": 0.5}, ["~output_rate", "0.5", "1 to 1000 Hz"]),
        ({"joy_timeout": 61}, ["~joy_timeout", "61", "0 to 60 s"]),
        ({"max_joy_age": -0.1}, ["~max_joy_age", "-0.1", "0 to 60 s"]),
        ({"max_linear_speed": -1}, ["~max_linear_speed", "-1", "0 to 1000 m/s (0: no limit)"]),
        ({"max_linear_speed": -0.5}, ["~max_linear_speed", "-0.5"]),
        ({"max_angular_speed": -0.5}, ["~max_angular_speed", "-0.5", "0 to 1000 rad/s"]),
        ({"max_linear_acceleration": -0.5}, ["~max_linear_acceleration", "0 to 1000 m/s2"]),
        ({"max_angular_acceleration": 1001}, ["~max_angular_acceleration", "0 to 1000 rad/s2"]),
        ({"diagnostic_period": 0}, ["~diagnostic_period", "0.1 to 60 s"]),
        ({"gamepad_axes": -2}, ["~gamepad_axes", "-2", "or -1 for any"]),
        ({"max_angular_acceleration": None}, ["~max_angular_acceleration", "None"]),
        ({"log_rate": -0.5}, ["~log_rate", "-0.5", "0 to 1000 lines a second"]),
        ({"log_rate": 1000.5}, ["~log_rate", "1000.5", "0 to 1000 lines a second"]),
        ({"gamepad_axes": "six"}, ["~gamepad_axes", "'six'"]),
        ({"axis_liner": 1}, ["~axis_liner", "axis_linear"]),
    ],
)
def test_an_error_names_parameter_value_and_what_is_allowed(given, words):
    with pytest.raises(ValueError, match="~") as error:
        load(given)
    text = str(error.value)
    assert "\n" not in text
    for word in words:
        assert word in text


def test_the_least_and_the_most_are_allowed():
    least = {
        "stop_messages": 1, "output_rate": 1, "joy_timeout": 0, "diagnostic_period": 0.1,
        "log_rate": 0, "gamepad_axes": -1,
    }  # fmt: skip
    most = {
        "stop_messages": 100, "output_rate": 1000, "joy_timeout": 60, "diagnostic_period": 60,
        "log_rate": 1000,
    }  # fmt: skip
    for given in (least, most):
        p = load(given)
        assert {name: getattr(p, name) for name in given} == given
    assert load({"scale_linear": -100, "scale_angular": 100}).axes[0].scale == -100
    assert load({"axis_linear": -1, "axis_angular": 0}).axes == (Axis(YAW, 0, 1.0, 1.0),)


def test_nobody_changes_what_was_checked():
    parameters = load({})
    for thing, name in ((parameters, "joy_timeout"), (parameters.axes[0], "scale")):
        with pytest.raises(FrozenInstanceError):
            setattr(thing, name, 1.0)


def test_all_defaults_written_out():
    p = load({})
    assert (p.stop_messages, p.output_rate, p.max_joy_age, p.inverted_reverse) == (5, 20, 0, False)
    assert (p.max_linear_speed, p.max_angular_speed) == (0, 0)
    assert (p.max_linear_acceleration, p.max_angular_acceleration) == (0, 0)
    assert (p.gamepad_axes, p.diagnostic_period) == (-1, 1)


@pytest.mark.parametrize(("enable", "turbo"), [(0, -1), (-1, 0), (1, 0), (0, 1)])
def test_button_0_is_a_button(enable, turbo):
    given = {"enable_button": enable, "enable_turbo_button": turbo, "require_enable_button": True}
    assert load(given).require_enable_button
