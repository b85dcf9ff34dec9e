"""Limits on speed and acceleration (pure). A velocity is a tuple of six floats.

The first three are linear x, y, z [m/s], the last three angular x, y, z [rad/s]; REP-103. The
linear and the angular part are limited as vectors, which keeps their direction.
"""

import math

ZERO = (0.0,) * 6


def limit_speed(velocity, max_linear, max_angular):
    """The velocity with both parts within their largest length [m/s, rad/s]; infinity is none."""
    x, y, z, roll, pitch, yaw = velocity
    linear = math.hypot(x, y, z)
    if linear > max_linear:
        x, y, z = (max_linear * (v / linear) for v in (x, y, z))
    angular = math.hypot(roll, pitch, yaw)
    if angular > max_angular:
        roll, pitch, yaw = (max_angular * (v / angular) for v in (roll, pitch, yaw))
    return x, y, z, roll, pitch, yaw


def approach(velocity, target, max_linear_change, max_angular_change):
    """The velocity one step nearer to target, changed by at most so much [m/s, rad/s]."""
    change = tuple(wanted - now for wanted, now in zip(target, velocity))
    step = limit_speed(change, max_linear_change, max_angular_change)
    if step == change:
        return target  # exactly, not up to rounding: a robot that should stand must stand
    return tuple(now + by for now, by in zip(velocity, step))
