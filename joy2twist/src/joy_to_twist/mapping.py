"""From the axes and buttons of a joystick to the velocity that the user asks for.

A velocity is linear x, y, z [m/s] and angular x, y, z [rad/s]; REP-103. The linear and the angular
part are limited as vectors, which keeps their direction.
"""

from __future__ import annotations

import math
from typing import Sequence

from joy_to_twist.parameters import COMPONENTS, Parameters
from node_kit.rules.arming import Velocity
from node_kit.rules.released import are_released

# A stick gives -1 to 1, and other devices a few hundred. A larger value is noise.
LARGEST_AXIS_VALUE = 1e6


class BadJoyError(ValueError):
    """A Joy message must not drive a robot; the text is the reason, in one line."""


class Mapping:
    """The meaning of each axis and button."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        # Tuples, for speed: this is read for every message.
        self._axes = [(a.component, a.index, a.scale, a.turbo_scale) for a in parameters.axes]
        self._turbo = parameters.enable_turbo_button
        self._enable = parameters.enable_button
        self._free = not parameters.require_enable_button
        self._needed_axes = 1 + max((a.index for a in parameters.axes), default=-1)
        self._stop, self._reset = parameters.stop_button, parameters.stop_reset_button
        self._needed_buttons = 1 + max(self._enable, self._stop, self._reset)
        self._curve = parameters.axis_curve
        self._inverted_reverse = parameters.inverted_reverse
        self._max_linear = parameters.max_linear_speed or math.inf
        self._max_angular = parameters.max_angular_speed or math.inf

    def velocity(self, axes: Sequence[float], buttons: Sequence[int]) -> Velocity | None:
        """Return the requested velocity, or None if the dead-man button is released.

        axes: about -1 to 1. buttons: 0 or 1. Raises BadJoyError.
        """
        if len(axes) < self._needed_axes or len(buttons) < self._needed_buttons:
            raise BadJoyError(self._what_is_missing(axes, buttons))
        # One comparison detects NaN (which compares false), infinity and noise.
        if not math.hypot(*axes) <= LARGEST_AXIS_VALUE:
            raise BadJoyError(f"not every axis has a usable value: {list(axes)}")

        turbo = 0 <= self._turbo < len(buttons) and buttons[self._turbo]
        if not (turbo or self._free or (self._enable >= 0 and buttons[self._enable])):
            return None
        velocity = [0.0] * 6
        for component, index, scale, turbo_scale in self._axes:
            value = math.copysign(abs(axes[index]) ** self._curve, axes[index])
            velocity[component] = value * (turbo_scale if turbo else scale)
        if self._inverted_reverse and velocity[0] < 0:
            velocity[5] = -velocity[5]
        return limit_speed(tuple(velocity), self._max_linear, self._max_angular)

    def released(self, axes: Sequence[float], velocity: Velocity | None) -> bool:
        """Return whether everything is released. velocity: what velocity() returned."""
        sticks = (axes[index] for _, index, _, _ in self._axes)
        return (velocity is None or self._free) and are_released(sticks)

    def stops(self, buttons: Sequence[int]) -> bool:
        """Return whether the stop button is pressed, in a good message or a bad one."""
        return 0 <= self._stop < len(buttons) and bool(buttons[self._stop])

    def resets(self, buttons: Sequence[int]) -> bool:
        """Return whether a good message has the reset button pressed, and not the stop button."""
        return bool(buttons[self._reset]) and not self.stops(buttons)

    def _what_is_missing(self, axes: Sequence[float], buttons: Sequence[int]) -> str:
        for component, index, _, _ in self._axes:
            if index >= len(axes):
                return f"no axis {index} (-> {COMPONENTS[component]}): it has {len(axes)} axes"
        names = ("enable_button", "stop_button", "stop_reset_button")
        name = max(names, key=lambda name: getattr(self._parameters, name))
        return f"no button {self._needed_buttons - 1} (~{name}): it has {len(buttons)} buttons"

    @property
    def deadman(self) -> str:
        """The number of the button that must be held, or "none"."""
        if not self._parameters.require_enable_button:
            return "none"
        return str(self._enable if self._enable >= 0 else self._turbo)

    def describe(self) -> list[str]:
        """Return lines that describe the mapping, such as one for each axis in use."""
        p = self._parameters
        held = [f"{p.enable_button}"] if p.require_enable_button and p.enable_button >= 0 else []
        held += [f"{self._turbo} for turbo"] if self._turbo >= 0 else []
        hold = f"hold button {', or '.join(held)}" if held else "no dead-man button"
        lines = []
        for axis in p.axes:
            unit = "m/s" if COMPONENTS[axis.component].startswith("linear") else "rad/s"
            turbo = f" (turbo: {axis.turbo_scale:g} {unit})" if self._turbo >= 0 else ""
            lines.append(
                f"axis {axis.index} -> {COMPONENTS[axis.component]} "
                f"at {axis.scale:g} {unit}{turbo}; {hold}"
            )
        lines = lines or ["no axis drives the robot: ~axis_linear and ~axis_angular are -1"]
        if p.stop_button >= 0:
            lines.append(f"button {p.stop_button} stops, until button {p.stop_reset_button}")
        if p.arm_on_neutral:
            lines.append("nothing moves before the sticks and the dead-man button are released")
        if p.joy_timeout:
            lines.append(f"no message of the joystick for {p.joy_timeout:g} s stops the robot")
        if p.vigilance_timeout:
            lines.append(f"no change of the joystick for {p.vigilance_timeout:g} s stops the robot")
        return lines


def limit_speed(velocity: Velocity, max_linear: float, max_angular: float) -> Velocity:
    """Return the velocity with both vectors limited in length; infinity is no limit."""
    x, y, z, roll, pitch, yaw = velocity
    linear = math.hypot(x, y, z)
    if linear > max_linear:
        x, y, z = (max_linear * (v / linear) for v in (x, y, z))
    angular = math.hypot(roll, pitch, yaw)
    if angular > max_angular:
        roll, pitch, yaw = (max_angular * (v / angular) for v in (roll, pitch, yaw))
    return x, y, z, roll, pitch, yaw


def approach(
    velocity: Velocity, target: Velocity, max_linear_change: float, max_angular_change: float
) -> Velocity:
    """Return the velocity one step nearer to target, within the largest changes [m/s, rad/s]."""
    change = tuple(wanted - now for wanted, now in zip(target, velocity))
    step = limit_speed(change, max_linear_change, max_angular_change)
    if step == change:
        return target  # exactly, without rounding: a robot that should stand must stand
    return tuple(now + by for now, by in zip(velocity, step))
