"""The private parameters of the node: from a dict to a checked, frozen Parameters (pure, no ROS).

The names and meanings of axis_*, scale_*, enable_* are those of the C++ node teleop_twist_joy, and
require_enable_button and inverted_reverse those of its ROS 2 version, so that its YAML files load
unchanged. Two defaults differ, so that the bare node is the tutorial's: every scale is 1, and
enable_button is -1 (no dead-man) where the C++ node has button 0.
"""

from dataclasses import dataclass, field, fields
from typing import Any, Dict, Tuple

LINEAR = ("x", "y", "z")
ANGULAR = ("roll", "pitch", "yaw")  # turning about x, y, z
COMPONENTS = ("linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z")

# Far beyond any robot; keeps every product of scale and axis finite. [m/s or rad/s]
LARGEST_SCALE = 1000

# Stands for "not given": the default then depends on another parameter.
_FROM_OTHERS = None


@dataclass(frozen=True)
class Axis:
    """One joystick axis that drives one component of the velocity.

    component: index into COMPONENTS. index: of the axis in the Joy message.
    scale, turbo_scale: velocity at full deflection [m/s or rad/s].
    """

    component: int
    index: int
    scale: float
    turbo_scale: float


def _is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(value):
    return isinstance(value, float) or _is_whole(value)


def _is_index(value):
    return _is_whole(value) and value >= -1


def _is_scale(value):
    return _is_number(value) and abs(value) <= LARGEST_SCALE


def number(default, low, high, allowed):
    """A number from low to high, both included."""
    return field(
        default=default,
        metadata={"valid": lambda v: _is_number(v) and low <= v <= high, "allowed": allowed},
    )


def _index(default, allowed):
    """A whole number, -1 for none."""
    return field(default=default, metadata={"valid": _is_index, "allowed": allowed})


def flag(default):
    return field(
        default=default,
        metadata={"valid": lambda v: isinstance(v, bool), "allowed": "true or false"},
    )


_BUTTON = "a button number, or -1 for none"
_SECONDS = "a number of seconds from 0 (off) to 60"
_LIMIT = "a number from 0 (off) to 1000"


@dataclass(frozen=True)
class Parameters:
    """All parameters of the node, checked. Units: m, s, rad, Hz."""

    axes: Tuple[Axis, ...]
    enable_button: int = _index(-1, _BUTTON)
    enable_turbo_button: int = _index(-1, _BUTTON)
    require_enable_button: bool = flag(_FROM_OTHERS)
    inverted_reverse: bool = flag(False)
    joy_timeout: float = number(0.5, 0, 60, _SECONDS)
    max_joy_age: float = number(0.0, 0, 60, _SECONDS)
    arm_on_neutral: bool = flag(False)
    stop_messages: int = field(
        default=5,
        metadata={"valid": lambda v: _is_whole(v) and 1 <= v <= 100, "allowed": "from 1 to 100"},
    )
    output_rate: float = number(20.0, 1, 1000, "a number of Hz from 1 to 1000")
    max_linear_speed: float = number(0.0, 0, 1000, _LIMIT)
    max_angular_speed: float = number(0.0, 0, 1000, _LIMIT)
    max_linear_acceleration: float = number(0.0, 0, 1000, _LIMIT)
    max_angular_acceleration: float = number(0.0, 0, 1000, _LIMIT)
    gamepad_axes: int = _index(-1, "the number of axes of the gamepad, or -1 for any")
    log_rate: float = number(50.0, 0, 1000, "a number of lines a second from 0 (off) to 1000")
    diagnostic_period: float = number(1.0, 0.1, 60, "a number of seconds from 0.1 to 60")


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
    plain = {f.name: f for f in fields(Parameters) if f.metadata}
    unknown = sorted(set(given) - set(plain) - set(AXIS_DEFAULTS))
    if unknown:
        known = ", ".join(sorted([*plain, *AXIS_DEFAULTS]))
        raise ValueError(f"There is no parameter ~{unknown[0]}; the parameters are {known}.")

    values = {name: given.get(name, f.default) for name, f in plain.items()}
    if values["require_enable_button"] is _FROM_OTHERS:
        values["require_enable_button"] = values["enable_button"] != -1
    for name, value in values.items():
        metadata = plain[name].metadata
        check(metadata["valid"](value), name, value, metadata["allowed"])

    enable, turbo = values["enable_button"], values["enable_turbo_button"]
    check(
        enable == -1 or enable != turbo,
        "enable_turbo_button",
        turbo,
        "a button other than ~enable_button",
    )
    check(
        not values["require_enable_button"] or max(enable, turbo) >= 0,
        "require_enable_button",
        True,
        "true only with ~enable_button or ~enable_turbo_button",
    )
    axes = _axes(given, "linear", LINEAR, 0) + _axes(given, "angular", ANGULAR, len(LINEAR))
    return Parameters(axes=tuple(axes), **values)


def _axes(given, kind, names, first_component):
    """The axes that drive the linear or the angular velocity.

    As in the C++ node, an axis_* number stands for x or yaw and a scale_* number for every
    component, and with axis_linear as a number scale_linear_turbo is 1 unless given. Any other
    turbo scale that is not given is that without turbo (in the C++ node it may become 0).
    """
    parameter = f"axis_{kind}"
    indices = given.get(parameter, AXIS_DEFAULTS[parameter])
    _check_each(parameter, indices, names, _is_index, "an axis number or -1 for none")
    by_name = isinstance(indices, dict)
    if not by_name:
        indices = {"x" if kind == "linear" else "yaw": indices}
    used = [name for name in names if indices.get(name, -1) >= 0]

    normal = _scales(given, f"scale_{kind}", names, used)
    parameter = f"scale_{kind}_turbo"
    if parameter not in given and (by_name or AXIS_DEFAULTS[parameter] is _FROM_OTHERS):
        turbo = normal
    else:
        turbo = _scales(given, parameter, names, used, otherwise=normal)
    return [
        Axis(first_component + names.index(name), indices[name], normal[name], turbo[name])
        for name in used
    ]


def _scales(given, parameter, names, used, otherwise=None):
    """The scale of every used component, by its name."""
    value = given.get(parameter, AXIS_DEFAULTS[parameter])
    allowed = f"a number from -{LARGEST_SCALE} to {LARGEST_SCALE}"
    _check_each(parameter, value, names, _is_scale, allowed)
    if not isinstance(value, dict):
        value = dict.fromkeys(names, value)
    scales = {**(otherwise or {}), **value}
    missing = [name for name in used if name not in scales]
    check(not missing, parameter, value, f"a map that has {', '.join(missing)} too")
    return {name: float(scales[name]) for name in used}


def _check_each(parameter, value, names, valid, allowed):
    """Check one value, or each value of a map from component name to value."""
    if isinstance(value, dict):
        fits = value and all(name in names and valid(v) for name, v in value.items())
    else:
        fits = valid(value)
    check(fits, parameter, value, f"{allowed}, or a map from {', '.join(names)} to such")


def check(valid, parameter, value, allowed):
    if not valid:
        raise ValueError(f"Parameter ~{parameter} is {value!r}; allowed is {allowed}.")
