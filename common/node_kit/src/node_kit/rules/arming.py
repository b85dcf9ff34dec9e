"""The rules after a loss, which joy2twist shares with the multiplexer.

Times are in seconds of one clock that never jumps.
"""

from typing import Tuple

Velocity = Tuple[float, ...]  # linear x, y, z [m/s] and angular x, y, z [rad/s], REP-103
ZERO: Velocity = (0.0,) * 6
DRIVING = "driving"  # the state on /diagnostics in which joy2twist drives
# After a longer silence during a motion, a velocity may have been delayed by a broken network.
SILENCE_S = 0.5
SETTLING_S = 0.25  # by then, messages sent during an outage or a suspension have arrived


class Arming:
    """Decides whether joystick messages may move the robot.

    A loss disarms. A message with everything released arms again.
    """

    def __init__(self, armed: bool = True) -> None:
        """Start armed, or wait until everything is released."""
        self.armed = armed
        self.released = armed  # whether the newest message has everything released

    def lose(self) -> None:
        """Disarm: the joystick or the robot was lost."""
        self.armed = self.released = False

    def hear(self, released: bool) -> bool:
        """Take whether a message has everything released; return whether it may move the robot."""
        self.armed = self.armed or released
        self.released = released
        return self.armed


class Resumption:
    """Decides which messages to ignore after a suspension: all for SETTLING_S."""

    def __init__(self) -> None:
        self._seen = 0
        self._settled_at = 0.0

    def notice(self, number: int, now: float) -> bool:
        """Return whether there was a new suspension. number: of suspensions so far."""
        if number == self._seen:
            return False
        self._seen = number
        self._settled_at = now + SETTLING_S
        return True

    def is_old(self, now: float) -> bool:
        """Return whether a message that arrives now may have been sent during the suspension."""
        return now < self._settled_at
