"""The sign of life of a software joystick: held sticks tremble by one bit.

joy2twist stops a robot whose joystick does not change (~vigilance_timeout), such as a radio gamepad
out of range. A held key or a thumb on glass does not change either, but its program knows that it
is alive.
"""

import itertools
from typing import Iterator, Tuple

EVERY = 8  # one in this many equal messages trembles: each 0.4 s at 20 Hz
LAST_BIT = 2.0**-23  # fraction of a float32, the type of axes in sensor_msgs/Joy


class Trembling:
    """Changes the last bit of the axes in some of several equal messages."""

    def __init__(self) -> None:
        """Start without a message."""
        self._last: Tuple[float, ...] = ()
        self._equal: Iterator[int] = itertools.count(1)  # messages in a row

    def shown(self, axes: Tuple[float, ...]) -> Tuple[float, ...]:
        """Return the axes to publish; an axis at 0 does not change."""
        if axes != self._last:
            self._last, self._equal = axes, itertools.count(1)
        if next(self._equal) % EVERY:
            return axes
        return tuple([axis * (1.0 - LAST_BIT) for axis in axes])
