"""The rule of arming (pure): after a loss nothing moves before everything was seen at rest."""

import math


class Arming:
    """Decides whether one sender of joystick messages or velocities may move the robot.

    A loss disarms. A rest arms again: messages in which all is released, over rest_s. Times are
    in seconds of one clock that never jumps.
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
