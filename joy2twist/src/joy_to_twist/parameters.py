"""The private parameters of the node: from a dict to a checked, frozen Parameters (pure, no ROS).

The YAML files of teleop_twist_joy, a C++ node, load unchanged. Two defaults differ, so that the
bare node is the tutorial's: every scale is 1, and enable_button is -1 (no dead-man), not 0.
"""

import itertools
from dataclasses import dataclass
from typing import Any, Dict, Tuple

from node_kit.parameters import (
    checked,
    is_number,
    is_whole,
    number,
    parameter,
    switch,
    whole_number,
)

LINEAR = ("x", "y", "z")
ANGULAR = ("roll", "pitch", "yaw")  # turning about x, y, z
COMPONENTS = ("linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z")

# Far beyond any robot on wheels; what is larger is a slip of the keys. [m/s or rad/s]
LARGEST_SCALE = 100
_FROM_OTHERS = None  # the default depends on another parameter


@dataclass(frozen=True)
class Axis:
    """One joystick axis that drives one component of the velocity."""

    component: int  # index into COMPONENTS
    index: int  # of the axis in the Joy message
    scale: float  # velocity at full deflection [m/s or rad/s]
    turbo_scale: float  # the same with the turbo button


_BUTTON = whole_number(-1, allowed="a button number, or -1 for none")
_TIMEOUT = number(0, 60, "s (0: off)")
_SPEED = number(0, 1000, "m/s (0: no limit)")
_TURN = number(0, 1000, "rad/s (0: no limit)")


@dataclass(frozen=True)
class Parameters:
    """All parameters of the node, checked. Units: m, s, rad, Hz."""

    axes: Tuple[Axis, ...]
    enable_button: int = parameter(-1, _BUTTON)
    enable_turbo_button: int = parameter(-1, _BUTTON)
    require_enable_button: bool = parameter(_FROM_OTHERS, switch)
    inverted_reverse: bool = parameter(False, switch)
    joy_timeout: float = parameter(0.5, _TIMEOUT)
    max_joy_age: float = parameter(0.0, _TIMEOUT)
    arm_on_neutral: bool = parameter(False, switch)
    vigilance_timeout: float = parameter(0.0, number(1, 60, "s, or 0 for off", off=0))
    stop_button: int = parameter(-1, _BUTTON)
    stop_reset_button: int = parameter(-1, _BUTTON)
    axis_curve: float = parameter(1.0, number(1, 5, "(1: linear)"))
    stop_messages: int = parameter(5, whole_number(1, 100, "a whole number from 1 to 100"))
    output_rate: float = parameter(20.0, number(1, 1000, "Hz"))
    max_linear_speed: float = parameter(0.0, _SPEED)
    max_angular_speed: float = parameter(0.0, _TURN)
    max_linear_acceleration: float = parameter(0.0, number(0, 1000, "m/s2 (0: no limit)"))
    max_angular_acceleration: float = parameter(0.0, number(0, 1000, "rad/s2 (0: no limit)"))
    gamepad_axes: int = parameter(
        -1, whole_number(-1, allowed="the number of axes of the gamepad, or -1 for any")
    )
    log_rate: float = parameter(50.0, number(0, 1000, "lines a second (0: none)"))
    diagnostic_period: float = parameter(1.0, number(0.1, 60, "s"))


# The parameters that make up Parameters.axes, with their defaults.
AXIS_DEFAULTS = {
    "axis_linear": 1,
    "axis_angular": 0,
    "scale_linear": 1.0,
    "scale_linear_turbo": 1.0,
    "scale_angular": 1.0,
    "scale_angular_turbo": _FROM_OTHERS,  # scale_angular
}


def load(given: Dict[str, Any]) -> Parameters:
    """Check the given private parameters and fill in the defaults.

    Raises ValueError, one line that names the parameter, its value and what is allowed.
    """
    values = checked(Parameters, given, others=AXIS_DEFAULTS)
    enable, turbo = values["enable_button"], values["enable_turbo_button"]
    if values["require_enable_button"] is _FROM_OTHERS:
        values["require_enable_button"] = enable != -1
    _check_buttons(values)
    if values["require_enable_button"] and max(enable, turbo) < 0:
        raise ValueError(
            "~require_enable_button: True: must be false without ~enable_button"
            " and ~enable_turbo_button"
        )
    if values["vigilance_timeout"] and not values["arm_on_neutral"]:
        raise ValueError(
            f"~vigilance_timeout: {values['vigilance_timeout']:g}: needs ~arm_on_neutral: true"
        )
    axes = _axes(given, "linear", LINEAR, 0) + _axes(given, "angular", ANGULAR, len(LINEAR))
    return Parameters(axes=tuple(axes), **values)


def _check_buttons(values):
    names = ("enable_button", "enable_turbo_button", "stop_button", "stop_reset_button")
    for one, other in itertools.combinations(names, 2):
        if values[one] == values[other] != -1:
            raise ValueError(f"~{other}: {values[other]}: must be a button other than ~{one}")
    for one, other in (("stop_button", "stop_reset_button"), ("stop_reset_button", "stop_button")):
        if values[one] >= 0 > values[other]:
            raise ValueError(f"~{one}: {values[one]}: needs ~{other}")


def _axes(given, kind, names, first_component):
    """The axes that drive the linear or the angular velocity.

    As in the C++ node, an axis_* number stands for x or yaw and a scale_* number for every
    component, and with axis_linear as a number scale_linear_turbo is 1 unless given. Any other
    turbo scale that is not given is that without turbo (in the C++ node it may become 0).
    """
    indices = _value(given, f"axis_{kind}", names, _is_index, "an axis number, -1 for none")
    by_name = isinstance(indices, dict)
    if not by_name:
        indices = {"x" if kind == "linear" else "yaw": indices}
    used = [name for name in names if indices.get(name, -1) >= 0]
    normal = turbo = _scales(given, f"scale_{kind}", names, used, {})
    name = f"scale_{kind}_turbo"
    if name in given or not (by_name or AXIS_DEFAULTS[name] is _FROM_OTHERS):
        turbo = _scales(given, name, names, used, normal)
    return [
        Axis(first_component + names.index(name), indices[name], normal[name], turbo[name])
        for name in used
    ]


def _scales(given, name, names, used, otherwise):
    """The scale of every used component, by its name."""
    value = _value(given, name, names, _is_scale, f"from -{LARGEST_SCALE} to {LARGEST_SCALE}")
    scales = {**otherwise, **(value if isinstance(value, dict) else dict.fromkeys(names, value))}
    missing = [one for one in used if one not in scales]
    if missing:
        raise ValueError(f"~{name}: {value!r}: must be a map that has {', '.join(missing)} too")
    return {one: float(scales[one]) for one in used}


def _is_index(value):
    return is_whole(value) and value >= -1


def _is_scale(value):
    return is_number(value) and abs(value) <= LARGEST_SCALE


def _value(given, name, names, valid, allowed):
    """The value of a parameter: one that is valid, or a map from component names to such."""
    value = given.get(name, AXIS_DEFAULTS[name])
    each = value if isinstance(value, dict) else {names[0]: value}
    if not each or not all(component in names and valid(one) for component, one in each.items()):
        allowed = f"a number ({allowed}), or a map from {', '.join(names)} to such"
        raise ValueError(f"~{name}: {value!r}: must be {allowed}")
    return value
