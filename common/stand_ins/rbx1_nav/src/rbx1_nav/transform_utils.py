"""Functions for angles, with the names that programs after ROS by Example import."""

from __future__ import annotations

from math import atan2, remainder, tau
from typing import Any


def quat_to_angle(quat: Any) -> float:
    """Return the yaw [rad] of a geometry_msgs/Quaternion."""
    aside = 2.0 * (quat.w * quat.z + quat.x * quat.y)
    ahead = quat.w * quat.w + quat.x * quat.x - quat.y * quat.y - quat.z * quat.z
    return atan2(aside, ahead)


def normalize_angle(angle: float) -> float:
    """Return the angle [rad] wrapped into -pi to pi."""
    return remainder(angle, tau)
