"""The private parameters of the node, each declared once.

The YAML files of teleop_twist_joy, a C++ node, load unchanged. Two defaults differ, so that
the bare node is the tutorial's: every scale is 1, and enable_button is -1 (no dead-man), not 0.
`./tutorial lint --fix` writes the README's table from these declarations.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any, Callable, Mapping

from node_kit.parameters.declaration import (
    Allowed,
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
# [m/s or rad/s] Faster than any robot on wheels; a larger value is a typing error.
LARGEST_SCALE = 100


@dataclass(frozen=True)
class AxisMapping:
    """One joystick axis that drives one component of the velocity."""

    component: int  # index into COMPONENTS
    index: int  # axis in the Joy message
    scale: float  # velocity at full deflection [m/s or rad/s]
    turbo_scale: float  # the same with the turbo button


def _one_or_each(names: tuple[str, ...], fits: Callable[[Any], bool], allowed: str) -> Allowed:
    def all_fit(value: Any) -> bool:
        if not isinstance(value, dict):
            return fits(value)
        return bool(value) and all(name in names and fits(part) for name, part in value.items())

    return Allowed(f"a number ({allowed}), or a map from {', '.join(names)} to such", all_fit)


def _is_axis(value: Any) -> bool:
    return is_whole(value) and value >= -1


def _is_scale(value: Any) -> bool:
    return is_number(value) and abs(value) <= LARGEST_SCALE


_NONE = "an axis number, -1 for none"
_RANGE = f"from -{LARGEST_SCALE} to {LARGEST_SCALE}"
_LINEAR_AXES, _ANGULAR_AXES = (_one_or_each(names, _is_axis, _NONE) for names in (LINEAR, ANGULAR))
_LINEAR_SCALES = _one_or_each(LINEAR, _is_scale, f"{_RANGE} m/s")
_ANGULAR_SCALES = _one_or_each(ANGULAR, _is_scale, f"{_RANGE} rad/s")
_BUTTON = whole_number(-1, allowed="a button number, or -1 for none")
_TIMEOUT = number(0, 60, "s (0: off)")
_SPEED = number(0, 1000, "m/s (0: no limit)")
_TURN = number(0, 1000, "rad/s (0: no limit)")
_AXES = whole_number(-1, allowed="the number of axes of the gamepad, or -1 for any")


@dataclass(frozen=True)
class Parameters:
    """All parameters of the node, checked, with their defaults."""

    axis_linear: Any = parameter(1, _LINEAR_AXES, "the axis for linear.x, or `{x: 1, y: 0}`")
    axis_angular: Any = parameter(0, _ANGULAR_AXES, "the axis for angular.z, or `{yaw: 0}`")
    scale_linear: Any = parameter(1.0, _LINEAR_SCALES, "velocity at full deflection")
    scale_linear_turbo: Any = parameter(
        1.0, _LINEAR_SCALES, "with the turbo button; `~axis_linear` a map: as without turbo"
    )
    scale_angular: Any = parameter(1.0, _ANGULAR_SCALES, "velocity at full deflection")
    scale_angular_turbo: Any = parameter(
        None, _ANGULAR_SCALES, "with the turbo button", "as `~scale_angular`"
    )
    enable_button: int = parameter(-1, _BUTTON, "the dead-man button")
    enable_turbo_button: int = parameter(-1, _BUTTON, "turbo; drives without the dead-man, too")
    require_enable_button: bool = parameter(
        None, switch, "one of these two must be held", "true with `~enable_button`"
    )
    inverted_reverse: bool = parameter(False, switch, "while reversing, steer as a car does")
    axis_curve: float = parameter(
        1.0, number(1, 5, "(1: linear)"), "exponent of an axis: 2 or 3 is gentle near the middle"
    )
    stop_button: int = parameter(-1, _BUTTON, "stops until the reset; needs the next")
    stop_reset_button: int = parameter(-1, _BUTTON, "ends the effect of the stop button")
    joy_timeout: float = parameter(
        0.0, _TIMEOUT, "a longer silence stops the robot; for a gamepad 0.5, with autorepeat"
    )
    max_joy_age: float = parameter(
        0.0, _TIMEOUT, "an older message is not driven; needs synchronised clocks"
    )
    arm_on_neutral: bool = parameter(
        False, switch, "wait for released sticks and dead-man before driving"
    )
    vigilance_timeout: float = parameter(
        0.0,
        number(1, 60, "s, or 0 for off", off=0),
        "a joystick without change for so long stops a moving robot; needs `~arm_on_neutral`",
    )
    stop_messages: int = parameter(
        5, whole_number(1, 100, "a whole number from 1 to 100"), "zeros sent on a stop"
    )
    output_rate: float = parameter(
        20.0, number(1, 1000, "Hz"), "of these zeros, and of velocities with limited acceleration"
    )
    max_linear_speed: float = parameter(0.0, _SPEED, "of the vector")
    max_angular_speed: float = parameter(0.0, _TURN, "of the vector")
    max_linear_acceleration: float = parameter(0.0, number(0, 1000, "m/s2 (0: no limit)"))
    max_angular_acceleration: float = parameter(0.0, number(0, 1000, "rad/s2 (0: no limit)"))
    gamepad_axes: int = parameter(-1, _AXES, "with another number a hint is shown")
    log_rate: float = parameter(
        50.0, number(0, 1000, "lines a second (0: none)"), "messages displayed, at most"
    )
    diagnostic_period: float = parameter(
        1.0, number(0.1, 60, "s"), "between two messages on `/diagnostics`"
    )
    axes: tuple[AxisMapping, ...] = ()  # the meaning of the first six


def load(given: Mapping[str, Any]) -> Parameters:
    """Return Parameters, checked, with the defaults filled in. Raises ValueError, one line."""
    values = checked(Parameters, given)
    enable, turbo = values["enable_button"], values["enable_turbo_button"]
    if values["require_enable_button"] is None:
        values["require_enable_button"] = enable >= 0
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
    if isinstance(values["axis_linear"], dict) and "scale_linear_turbo" not in given:
        values["scale_linear_turbo"] = None
    linear, angular = _axes(values, "linear", LINEAR, 0), _axes(values, "angular", ANGULAR, 3)
    return Parameters(axes=tuple(linear + angular), **values)


def _check_buttons(values: dict[str, Any]) -> None:
    names = ("enable_button", "enable_turbo_button", "stop_button", "stop_reset_button")
    for first, second in itertools.combinations(names, 2):
        if values[first] == values[second] >= 0:
            raise ValueError(f"~{second}: {values[second]}: must be a button other than ~{first}")
    for name, partner in itertools.permutations(names[2:]):
        if values[name] >= 0 > values[partner]:
            raise ValueError(f"~{name}: {values[name]}: needs ~{partner}")


def _axes(
    values: dict[str, Any], kind: str, names: tuple[str, ...], first: int
) -> list[AxisMapping]:
    """Return the axes that drive the linear or the angular velocity.

    As in the C++ node, an axis_* number stands for x or yaw, and a scale_* number for every
    component. A missing turbo scale is the normal scale (in the C++ node it may be 0).
    """

    def of_each(value: Any) -> dict[str, Any]:
        return value if isinstance(value, dict) else dict.fromkeys(names, value)

    indices, scale = values[f"axis_{kind}"], values[f"scale_{kind}"]
    if not isinstance(indices, dict):
        indices = {"x" if kind == "linear" else "yaw": indices}
    used = [name for name in names if name in indices and indices[name] >= 0]
    normal, turbo = of_each(scale), values[f"scale_{kind}_turbo"]
    missing = [name for name in used if name not in normal]
    if missing:
        raise ValueError(
            f"~scale_{kind}: {scale!r}: must be a map that has {', '.join(missing)} too"
        )
    turbo = normal if turbo is None else {**normal, **of_each(turbo)}
    return [
        AxisMapping(
            first + names.index(name), indices[name], float(normal[name]), float(turbo[name])
        )
        for name in used
    ]
