"""The motion on the floor from the bytes of a nav_msgs/Odometry (pure)."""

from __future__ import annotations

import struct
from math import atan2, hypot, isfinite
from typing import NamedTuple

# Little-endian: seq, secs, nsecs (uint32 each), frame_id and child_frame_id (length and bytes),
# then as float64 position and quaternion, 36 covariances, linear and angular velocity.
_HEADER_BYTES = 12
_LENGTH = struct.Struct("<I")
_MOTION = struct.Struct("<7d288x6d")


LONGEST_STEP_M = 0.5  # within a period; what is more was carried, or odometry was not heard
FARTHEST_M = 1e6  # from the origin; what is beyond is no place of a robot


class Motion(NamedTuple):
    """x, y [m], yaw [rad] in the odometry frame; v [m/s], w [rad/s] in that of the base."""

    x: float
    y: float
    yaw: float
    v: float
    w: float


def motion(data: bytes) -> Motion:
    """Return the Motion, without the covariances; struct.error if the bytes are too short."""
    at = _HEADER_BYTES
    at += 4 + _LENGTH.unpack_from(data, at)[0]
    at += 4 + _LENGTH.unpack_from(data, at)[0]
    x, y, _, qx, qy, qz, qw, v, _, _, _, _, w = _MOTION.unpack_from(data, at)
    yaw = atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz)
    return Motion(x, y, yaw, v, w)


def is_somewhere(state: Motion) -> bool:
    finite = isfinite(state.x) and isfinite(state.y) and isfinite(state.yaw)
    return finite and max(abs(state.x), abs(state.y)) <= FARTHEST_M


def covered(last: Motion, new: Motion, so_far: float) -> float:
    """Return the distance [m] since the last reset; so_far: until the last Motion."""
    if new.x == new.y == new.yaw == 0.0:  # as a reset has it, and no drive by chance
        return 0.0
    step = hypot(new.x - last.x, new.y - last.y)
    return so_far + step if step <= LONGEST_STEP_M else so_far  # NaN is not less, either
