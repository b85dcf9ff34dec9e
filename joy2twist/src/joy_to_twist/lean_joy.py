"""A sensor_msgs/Joy that is read from the wire in a few steps."""

import struct

from sensor_msgs.msg import Joy

# Layout of a serialised Joy, little-endian: seq, secs, nsecs (uint32 each), the length of frame_id
# and its bytes, the number of axes and as many float32, the number of buttons and as many int32.
_STAMP = struct.Struct("<4xII")
_COUNT = struct.Struct("<I")
_FRAME_LENGTH_AT = 12


class LeanJoy(Joy):
    """A Joy to subscribe with, of which axes, buttons and stamp_ns are read, and nothing else.

    rospy lets the message class read its own bytes. After an idle pause, when the caches of the
    processor are cold, the general way (a Header, a Time, a decoded frame_id) takes most of the
    time that passes between a message and its velocity.
    """

    __slots__ = ("_data",)

    def __init__(self):
        """Leave everything to deserialize(), the only source of these messages."""

    def deserialize(self, data):
        """Read axes (tuple of floats) and buttons (tuple of ints); struct.error if cut."""
        self._data = data
        at = _FRAME_LENGTH_AT
        at += 4 + _COUNT.unpack_from(data, at)[0]
        axes = _COUNT.unpack_from(data, at)[0]
        self.axes = struct.unpack_from(f"<{axes}f", data, at + 4)
        at += 4 + 4 * axes
        buttons = _COUNT.unpack_from(data, at)[0]
        self.buttons = struct.unpack_from(f"<{buttons}i", data, at + 4)
        return self

    @property
    def stamp_ns(self):
        """The time of the reading [ns], on the clock of the joystick node."""
        secs, nsecs = _STAMP.unpack_from(self._data)
        return secs * 1_000_000_000 + nsecs
