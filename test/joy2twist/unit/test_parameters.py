"""Names, defaults and checks of the private parameters."""

from dataclasses import asdict

import pytest

from joy_to_twist.parameters import AxisMapping as Axis
from joy_to_twist.parameters import Parameters, load
from tutorial_testing.claims import claim

pytestmark = claim("Every parameter has the bounds of its table, and the presets are within them")
LINEAR_X, LINEAR_Y, LINEAR_Z, ROLL, PITCH, YAW = range(6)


def test_each_default_may_be_given():
    defaults = {name: value for name, value in asdict(Parameters()).items() if value is not None}
    del defaults["axes"]
    assert load(defaults) == load({})


@pytest.mark.parametrize(("given", "axes"), [
    ({}, [Axis(LINEAR_X, 1, 1.0, 1.0), Axis(YAW, 0, 1.0, 1.0)]),  # the node of the tutorial
    ({"axis_linear": 4, "scale_linear": 100, "axis_angular": 3, "scale_angular": 0.4},
     [Axis(LINEAR_X, 4, 100.0, 1.0), Axis(YAW, 3, 0.4, 0.4)]),
    ({"axis_linear": {"x": 1, "y": 2, "z": -1}, "scale_linear": {"x": 0.7, "y": 0.5, "z": 9},
      "scale_linear_turbo": {"x": 1.5}, "axis_angular": {"roll": 4, "pitch": 5, "yaw": 0},
      "scale_angular": {"roll": 3, "pitch": 2.0, "yaw": 1.0}},
     [Axis(LINEAR_X, 1, 0.7, 1.5), Axis(LINEAR_Y, 2, 0.5, 0.5), Axis(ROLL, 4, 3.0, 3.0),
      Axis(PITCH, 5, 2.0, 2.0), Axis(YAW, 0, 1.0, 1.0)]),
])  # fmt: skip
def test_a_number_stands_for_x_or_yaw_and_a_map_without_turbo_keeps_its_scale(given, axes):
    assert load(given).axes == tuple(axes)


@pytest.mark.parametrize(("given", "required"), [
    ({"enable_button": 0}, True),
    ({}, False),
    ({"enable_turbo_button": 5}, False),
    ({"enable_turbo_button": 5, "require_enable_button": True}, True),
    ({"enable_button": 4, "require_enable_button": False}, False),
])  # fmt: skip
def test_a_named_enable_button_is_required_unless_said_otherwise(given, required):
    assert load(given).require_enable_button is required


AXIS = "must be a number (an axis number, -1 for none), or a map from x, y, z to such"
SCALE = "must be a number (from -100 to 100 m/s), or a map from x, y, z to such"
BUTTON = "must be a button number, or -1 for none"
ARMED = {"arm_on_neutral": True}


@pytest.mark.parametrize(("name", "values", "words", "others"), [
    ("axis_linear", ["foo", 1.5, True, -2, {}, {"yaw": 1}, {"x": 1, "y": None}, [0]], AXIS, {}),
    ("scale_linear", ["fast", 100.5, -101, {"x": 1.0, "y": "fast"}], SCALE, {}),
    ("scale_linear", [{"x": 1.0}], "must be a map that has y too",
     {"axis_linear": {"x": 1, "y": 0}}),
    ("vigilance_timeout", [3], "needs ~arm_on_neutral: true", {}),
    ("vigilance_timeout", [0.3, 61], "must be a number from 1 to 60 s, or 0 for off", ARMED),
    ("stop_reset_button", [0], "needs ~stop_button", {}),
    ("stop_reset_button", [1], "must be a button other than ~stop_button", {"stop_button": 1}),
    ("stop_button", [4], "must be a button other than ~enable_button",
     {"enable_button": 4, "stop_reset_button": 1}),
    ("enable_turbo_button", [0], "must be a button other than ~enable_button",
     {"enable_button": 0}),
    ("enable_button", [1.0, -2], BUTTON, {}),
    ("require_enable_button", [True],
     "must be false without ~enable_button and ~enable_turbo_button", {}),
    ("gamepad_axes", [-2], "must be the number of axes of the gamepad, or -1 for any", {}),
    ("axis_liner", [1], "no such parameter; did you mean ~axis_linear?", {}),
])  # fmt: skip
def test_an_error_names_parameter_value_and_what_is_allowed(name, values, words, others):
    for value in values:
        with pytest.raises(ValueError) as error:
            load({name: value, **others})
        assert str(error.value) == f"~{name}: {value!r}: {words}"
