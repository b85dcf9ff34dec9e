"""Conversion between a velocity and the command for a Kobuki's wheels."""

from __future__ import annotations

from math import isfinite
from typing import Tuple

from kobuki_protocol.commands import BaseControl
from kobuki_protocol.feedback import int16

WHEEL_SEPARATION_M = 0.23  # diff_drive.cpp: bias
WHEEL_RADIUS_M = 0.035  # diff_drive.cpp
HALF_MM = 500.0 * WHEEL_SEPARATION_M
SMALL = 1e-4  # [m/s, rad/s] less counts as zero (diff_drive.cpp: epsilon)
REST = BaseControl(0, 0)
Velocity = Tuple[float, float]  # v [m/s], w [rad/s]


def base_control(v: float, w: float) -> BaseControl:
    """Return the command for v [m/s] and w [rad/s]. Raises ValueError if they are not finite.

    A radius of 0 means straight ahead; a radius of 1 means a turn on the spot, where the speed has
    the sign of w. Otherwise the speed is that of the outer wheel.
    """
    if not (isfinite(v) and isfinite(w)):
        raise ValueError(f"({v}, {w}) is not a velocity")
    if abs(w) < SMALL:
        return BaseControl(int16(1000.0 * v), 0)
    radius = 1000.0 * v / w
    if abs(v) < SMALL or abs(radius) <= 1.0:
        return BaseControl(int16(HALF_MM * w), 1)
    outer = radius + (HALF_MM if radius > 0.0 else -HALF_MM)
    return BaseControl(int16(outer * w), int16(radius))


def velocity_of(command: BaseControl) -> Velocity:
    """Return the velocity at which a Kobuki drives after a command."""
    speed, radius = float(command.speed), float(command.radius)
    if radius == 0.0:
        return 0.001 * speed, 0.0
    if radius == 1.0:
        return 0.0, speed / HALF_MM
    w = speed / (radius + (HALF_MM if radius > 0.0 else -HALF_MM))
    return 0.001 * radius * w, w


def control_values(v: float, w: float) -> list[int]:
    """Return the data of debug/raw_control_command: speed, radius, v [mm/s], w [mrad/s]."""
    command = base_control(v, w)
    return [command.speed, command.radius, int16(1000.0 * v), int16(1000.0 * w)]
