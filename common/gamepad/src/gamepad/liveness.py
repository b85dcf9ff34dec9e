"""The sign of life of a source that knows that it lives: held sticks tremble by one bit (pure).

joy2twist stops a robot whose joystick does not change (its ~vigilance_timeout), as a radio gamepad
out of reach does not. A key or a thumb on glass does not change either, but its program can answer
for it.
"""

import itertools
from typing import Iterator, Tuple

EVERY = 8  # one in this many equal messages trembles: 0.4 s at 20 Hz
LAST_BIT = 2.0**-23  # part of a float32, the type of axes in sensor_msgs/Joy


class Trembling:
    """Changes the axes of one message among equal ones by their last bit."""

    def __init__(self) -> None:
        """No message came yet."""
        self._last: Tuple[float, ...] = ()
        self._equal: Iterator[int] = itertools.count(1)  # messages in a row

    def shown(self, axes: Tuple[float, ...]) -> Tuple[float, ...]:
        """Return the axes to publish; an axis at 0 stays there."""
        if axes != self._last:
            self._last, self._equal = axes, itertools.count(1)
        if next(self._equal) % EVERY:
            return axes
        return tuple([axis * (1.0 - LAST_BIT) for axis in axes])
