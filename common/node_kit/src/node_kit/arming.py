"""The rules after a loss, shared by joy2twist, the multiplexer and the robot (pure).

Times are in seconds of one clock that never jumps.
"""

import math
from typing import Tuple

Velocity = Tuple[float, ...]  # linear x, y, z [m/s] and angular x, y, z [rad/s], REP-103
ZERO: Velocity = (0.0,) * 6
DRIVING = "driving"  # the state on /diagnostics in which joy2twist drives
SETTLING_S = 0.25  # by then a resumed process has read what was sent to it meanwhile


class Arming:
    """Decides whether one sender of joystick messages or velocities may move the robot.

    A loss disarms. A rest arms again: messages in which all is released, over rest_s.
    """

    def __init__(self, armed: bool = True, rest_s: float = 0.0) -> None:
        """Start armed, or wait for a rest. rest_s: how long a rest lasts; 0: one message."""
        self.armed = armed
        self.rests = armed  # all was released in the newest message
        self._rest_s = rest_s
        self.since = -math.inf  # begin of the newest rest [s]

    def lose(self) -> None:
        """Disarm: what drove, or what it drove, was lost."""
        self.armed = self.rests = False

    def hear(self, rests: bool, now: float) -> bool:
        """Take a message, and whether all is released in it; return whether it may move."""
        if rests and not self.rests:
            self.since = now
        if (rests or self.rests) and now - self.since >= self._rest_s:
            self.armed = True
        self.rests = rests
        return self.armed


class Resumption:
    """Decides what a receiver obeys after a suspension of its process.

    It obeys nothing for SETTLING_S, and then, where stops are asked for, nothing before a stop.
    """

    def __init__(self) -> None:
        self._seen = 0
        self._settled_at = 0.0
        self._needs_stop = False

    def notice(self, number: int, now: float) -> bool:
        """Return whether a suspension is new. number: of suspensions so far."""
        if number == self._seen:
            return False
        self._seen = number
        self._settled_at = now + SETTLING_S
        self._needs_stop = True
        return True

    def is_old(self, now: float) -> bool:
        """Return whether what comes now was sent during the suspension."""
        return now < self._settled_at

    def holds(self, stops: bool, now: float) -> bool:
        """Return whether to ignore a command that comes now. stops: whether it is a stop."""
        if self.is_old(now):
            return not stops
        self._needs_stop = self._needs_stop and not stops
        return self._needs_stop
