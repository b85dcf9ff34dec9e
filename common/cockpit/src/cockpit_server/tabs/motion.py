"""The motion of a robot on the floor, from a nav_msgs/Odometry."""

from __future__ import annotations

from math import atan2, cos, hypot, sin
from typing import Any, NamedTuple

from geometry_msgs.msg import Transform
from nav_msgs.msg import Odometry

LONGEST_STEP_M = 0.5  # within a period; beyond it the robot was carried, or odometry was missed
FARTHEST_M = 1e6  # from the origin; no robot is farther away


class Motion(NamedTuple):
    """x, y [m], yaw [rad] in the odometry frame; v [m/s], w [rad/s] in that of the base."""

    x: float
    y: float
    yaw: float
    v: float
    w: float


def motion(odometry: Odometry) -> Motion:
    """Return the Motion of an Odometry."""
    pose, twist = odometry.pose.pose, odometry.twist.twist
    yaw = yaw_of(pose.orientation)
    return Motion(pose.position.x, pose.position.y, yaw, twist.linear.x, twist.angular.z)


def yaw_of(q: Any) -> float:
    """Return the rotation [rad] on the floor of a quaternion of any length."""
    return atan2(2 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z)


def in_frame(state: Motion, transform: Transform) -> Motion:
    """Return a Motion in another frame. transform: of points to it."""
    place, yaw = transform.translation, yaw_of(transform.rotation)
    x = place.x + cos(yaw) * state.x - sin(yaw) * state.y
    y = place.y + sin(yaw) * state.x + cos(yaw) * state.y
    return state._replace(x=x, y=y, yaw=state.yaw + yaw)


def covered(last: Motion, new: Motion, so_far: float) -> float:
    """Return the distance [m] since the last reset. so_far: up to the last Motion."""
    if new.x == new.y == new.yaw == 0.0:  # A reset has this pose, and no drive by chance.
        return 0.0
    step = hypot(new.x - last.x, new.y - last.y)
    return so_far + step if step <= LONGEST_STEP_M else so_far  # NaN is not less.
