"""Who drives a topic of velocities: one client of the bridge, while nobody else publishes there."""

from __future__ import annotations

from typing import Hashable

# A panel that drives repeats its velocity once a second by default.
SILENCE_S = 2.0  # after which a client's motion is ended
# A program counts while its messages arrive, not while it is only registered: joy2twist is
# registered whenever it runs, and publishes nothing while its stick is released.
OTHERS_S = 1.0
KINDS = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped")
_VELOCITY_BYTES = 48  # six float64, at the end of both kinds


def moves(data: bytes) -> bool:
    """Return whether the bytes of a message of KINDS are a motion."""
    return any(data[-_VELOCITY_BYTES:])


class VelocityTopic:
    """The motion of a topic, and who else publishes on it. Times are monotonic [s]."""

    def __init__(self) -> None:
        self.driver: Hashable = None  # the client whose motion has not ended
        self._driven_s = self._other_s = float("-inf")
        self._other = ""

    def hear(self, sender: str, now: float) -> None:
        """Note a message of another node."""
        self._other, self._other_s = sender, now

    def refusal(self, client: Hashable, now: float) -> str:
        """Return why a client may not publish now, or ""."""
        if now - self._other_s < OTHERS_S:
            if self.driver == client:  # no zero: the topic is the other's
                self.driver = None
            return f"{self._other} publishes there"
        if self.driver not in (None, client):
            return "another client drives"
        return ""

    def command(self, client: Hashable, data: bytes, now: float) -> None:
        """Note a message that a client has published."""
        self.driver, self._driven_s = (client if moves(data) else None), now

    def end(self, client: Hashable) -> bool:
        """Return whether a zero is due, as a client stops publishing; once for each motion."""
        is_due = self.driver == client
        if is_due:
            self.driver = None
        return is_due

    def expire(self, now: float) -> bool:
        """Return whether a zero is due, as the driver is silent; once for each motion."""
        is_due = self.driver is not None and now - self._driven_s > SILENCE_S
        if is_due:
            self.driver = None
        return is_due
