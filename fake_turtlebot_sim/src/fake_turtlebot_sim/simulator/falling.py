"""When a wheel of the robot rolls over an edge, in closed form (pure).

The place where a wheel touches the ground is a point that drives an arc of its own, around the same
middle as the robot's; so it meets an edge as a disc without a radius meets a wall.
"""

from __future__ import annotations

from math import cos, sin
from typing import Sequence

from fake_turtlebot_sim.simulator.contact import TOUCH_M, Segment, drive_among
from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity


def fall(
    pose: Pose,
    velocity: Velocity,
    end_velocity: Velocity,
    dt: float,
    wheel_separation: float,
    edges: Sequence[Segment],
) -> tuple[float, tuple[bool, bool]] | None:
    """Return after which time [s] within dt which wheels, (left, right), drop, or None.

    The velocity (v [m/s], w [rad/s]) goes linearly to end_velocity.
    """
    x, y, yaw = pose
    times = []
    for aside in (0.5 * wheel_separation, -0.5 * wheel_separation):
        wheel = x - aside * sin(yaw), y + aside * cos(yaw), yaw
        begin, end = ((v - w * aside, w) for v, w in (velocity, end_velocity))
        pieces, met = drive_among(wheel, begin, end, dt, 0.0, edges)
        is_over = met is not None or len(pieces) > 1
        times.append(pieces[0].dt if is_over else dt + 1.0)
    first = min(times)
    if first > dt:
        return None
    speed = max(abs(velocity[0]), abs(end_velocity[0]), 1e-3)
    left, right = (time - first <= TOUCH_M / speed for time in times)
    return first, (left, right)
