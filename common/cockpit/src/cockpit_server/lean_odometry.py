"""A nav_msgs/Odometry of which only the motion on the floor is read."""

import struct
from math import atan2

from nav_msgs.msg import Odometry

# Layout of a serialised Odometry, little-endian: seq, secs, nsecs (uint32 each), frame_id and
# child_frame_id (length and bytes), then as float64 position and quaternion, 36 covariances, linear
# and angular velocity, 36 covariances.
_STAMP = struct.Struct("<4xII")
_LENGTH = struct.Struct("<I")
_MOTION = struct.Struct("<7d288x6d")


class LeanOdometry(Odometry):
    """stamp [s]; x, y [m], yaw [rad] in the odometry frame; v [m/s], w [rad/s] in the base's.

    The covariances take most of the time to read, and of thirty robots nobody looks at them.
    """

    __slots__ = ("stamp", "v", "w", "x", "y", "yaw")

    def __init__(self):
        """Leave everything to deserialize(), the only source of these messages."""

    def deserialize(self, data):
        """Read the motion; struct.error if cut."""
        seconds, nanoseconds = _STAMP.unpack_from(data)
        self.stamp = seconds + 1e-9 * nanoseconds
        at = _STAMP.size
        at += 4 + _LENGTH.unpack_from(data, at)[0]
        at += 4 + _LENGTH.unpack_from(data, at)[0]
        motion = _MOTION.unpack_from(data, at)
        self.x, self.y = motion[:2]
        qx, qy, qz, qw = motion[3:7]
        self.yaw = atan2(2 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz)
        self.v, self.w = motion[7], motion[12]
        return self
