"""Who drives a topic of velocities: one client of the bridge, while no other node publishes."""

from __future__ import annotations

from math import inf
from typing import Hashable

KINDS = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped")
# A panel that drives repeats its velocity once a second by default.
SILENCE_S = 2.0  # after which a client's motion is ended
# A node counts while its messages arrive, not while it is only registered: joy2twist is registered
# whenever it runs, and publishes nothing while its stick is released.
OTHERS_S = 1.0
_VELOCITY_BYTES = 48  # six float64, at the end of both kinds


class VelocityTopic:
    """The motion of a topic. Times are monotonic [s]."""

    def __init__(self) -> None:
        self._driver: Hashable = None  # the client whose motion has not ended
        self._driven_s = self._other_s = -inf
        self._other = ""

    def hear(self, node: str, now: float) -> None:
        """Note a message of another node, which takes the topic over."""
        self._other, self._other_s, self._driver = node, now, None

    def refusal(self, client: Hashable, now: float) -> str:
        """Return why a client may not publish now, or ""."""
        if now - self._other_s < OTHERS_S:
            return f"{self._other} publishes there: stop it, then wait {OTHERS_S:g} s"
        is_taken = self._driver not in (None, client)
        return f"another client drives: stop it, then wait {SILENCE_S:g} s" if is_taken else ""

    def command(self, client: Hashable, data: bytes, now: float) -> None:
        """Note a message that a client has published."""
        self._driver, self._driven_s = client if any(data[-_VELOCITY_BYTES:]) else None, now

    def is_zero_due(self, now: float, gone: Hashable = None) -> bool:
        """Return whether a motion ends, by silence or with a client that is gone; once for each."""
        is_silent = now - self._driven_s > SILENCE_S
        is_due = self._driver is not None and (is_silent or self._driver == gone)
        if is_due:
            self._driver = None
        return is_due
