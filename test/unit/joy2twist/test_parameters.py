"""Names, defaults and checks of the private parameters."""

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
        ({"axis_linear": "foo"}, "~axis_linear: 'foo': must be a number (an axis number, -1 for"),
        ({"axis_linear": 1.5}, "~axis_linear: 1.5: must be"),
        ({"axis_linear": True}, "~axis_linear: True: must be"),
        ({"axis_linear": -2}, "~axis_linear: -2: must be"),
        ({"axis_linear": {}}, "or a map from x, y, z to such"),
        ({"axis_linear": {"yaw": 1}}, "~axis_linear: {'yaw': 1}: must be"),
        ({"axis_linear": {"x": 1, "y": None}}, "~axis_linear: {'x': 1, 'y': None}: must be"),
        ({"axis_angular": {"x": 1}}, "or a map from roll, pitch, yaw to such"),
        ({"axis_angular": [0]}, "~axis_angular: [0]: must be"),
        ({"scale_linear": "fast"}, "~scale_linear: 'fast': must be a number (from -100 to 100"),
        ({"scale_linear": 100.5}, "~scale_linear: 100.5: must be"),
        ({"scale_linear": -101}, "~scale_linear: -101: must be"),
        ({"scale_linear": {"x": 1.0, "y": "fast"}}, "~scale_linear: {'x': 1.0, 'y': 'fast'}: must"),
        ({"scale_angular": float("nan")}, "~scale_angular: nan: must be"),
        ({"scale_angular_turbo": -1e6}, "~scale_angular_turbo: -1000000.0: must be"),
        ({"axis_linear": {"x": 1, "y": 0}, "scale_linear": {"x": 1.0}}, "a map that has y too"),
        ({"vigilance_timeout": 3.0}, "~vigilance_timeout: 3: needs ~arm_on_neutral: true"),
        ({"vigilance_timeout": 0.3, "arm_on_neutral": True}, "from 1 to 60 s, or 0 for off"),
        ({"stop_button": 1}, "~stop_button: 1: needs ~stop_reset_button"),
        ({"stop_reset_button": 1}, "~stop_reset_button: 1: needs ~stop_button"),
        ({"stop_button": 1, "stop_reset_button": 1}, "must be a button other than ~stop_button"),
        ({"stop_button": 4, "stop_reset_button": 1, "enable_button": 4}, "than ~enable_button"),
        ({"enable_button": 3, "enable_turbo_button": 3}, "~enable_turbo_button: 3: must be"),
        ({"enable_button": 1.0}, "~enable_button: 1.0: must be a button number"),
        ({"enable_button": -2}, "~enable_button: -2: must be"),
        ({"require_enable_button": True}, "without ~enable_button and ~enable_turbo_button"),
        ({"gamepad_axes": -2}, "~gamepad_axes: -2: must be the number of axes"),
        ({"axis_liner": 1}, "did you mean ~axis_linear?"),
    ],
)
def test_an_error_names_parameter_value_and_what_is_allowed(given, words):
    with pytest.raises(ValueError, match="~") as error:
        load(given)
    assert words in str(error.value)
    assert "\n" not in str(error.value)


# What is allowed at least and at most; a step beyond is refused.
BOUNDS = {
    "axis_curve": (1, 5), "joy_timeout": (0, 60), "max_joy_age": (0, 60), "stop_messages": (1, 100),
    "output_rate": (1, 1000), "max_linear_speed": (0, 1000), "max_angular_speed": (0, 1000),
    "max_linear_acceleration": (0, 1000), "max_angular_acceleration": (0, 1000),
    "log_rate": (0, 1000), "diagnostic_period": (0.1, 60), "scale_linear": (-100, 100),
}  # fmt: skip


@pytest.mark.parametrize("name", BOUNDS)
def test_the_least_and_the_most_are_allowed_and_no_more(name):
    least, most = BOUNDS[name]
    assert [getattr(load({name: value}), name) for value in (least, most)] == [least, most]
    for value in (least - 0.5, most + 0.5, None, "1", False):
        with pytest.raises(ValueError, match=rf"^~{name}: {value!r}: must be a .*number"):
            load({name: value})
