"""The rules of joy2twist after a loss, and what it shares with the multiplexer (pure).

Times are in seconds of one clock that never jumps.
"""

from typing import Tuple

Velocity = Tuple[float, ...]  # linear x, y, z [m/s] and angular x, y, z [rad/s], REP-103
ZERO: Velocity = (0.0,) * 6
DRIVING = "driving"  # the state on /diagnostics in which joy2twist drives
# After a longer silence in a motion, a velocity may be one that a broken network had kept.
SILENCE_S = 0.5
SETTLING_S = 0.25  # by then what was sent during an outage or a suspension has arrived


class Arming:
    """Decides whether joystick messages may move the robot.

    A loss disarms. A message in which all is released arms again.
    """

    def __init__(self, armed: bool = True) -> None:
        """Start armed, or wait for a rest."""
        self.armed = armed
        self.rests = armed  # all was released in the newest message

    def lose(self) -> None:
        """Disarm: what drove, or what it drove, was lost."""
        self.armed = self.rests = False

    def hear(self, rests: bool) -> bool:
        """Take whether all is released in a message; return whether it may move the robot."""
        self.armed = self.armed or rests
        self.rests = rests
        return self.armed


class Resumption:
    """Decides what a receiver obeys after a suspension of its process: nothing for SETTLING_S."""

    def __init__(self) -> None:
        self._seen = 0
        self._settled_at = 0.0

    def notice(self, number: int, now: float) -> bool:
        """Return whether a suspension is new. number: of suspensions so far."""
        if number == self._seen:
            return False
        self._seen = number
        self._settled_at = now + SETTLING_S
        return True

    def is_old(self, now: float) -> bool:
        """Return whether what comes now was sent during the suspension."""
        return now < self._settled_at
