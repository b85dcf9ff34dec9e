"""Ignores messages that were sent to a node while its process was suspended."""

from __future__ import annotations

import time
from collections import deque
from typing import Any

from node_kit.io.suspension import Suspensions
from node_kit.ros.rospy_patches.connections import established, header_of, is_connected, renew

# After a renewal [s]: rospy abandons a connection if its greeting fails once, which can happen on a
# busy machine.
LOOKS_AFTER_S = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0)


class FreshOnly:
    """Renews the connections of a node's subscribers after a suspension.

    The messages in the old connections are never read. A program that continues to send is obeyed
    again as soon as it has reconnected. For a hold-to-run style publisher this is a new subscriber,
    which it drives only once everything was released (prompt_publisher.VelocityPublisher).
    """

    def __init__(self, suspensions: Suspensions | None = None) -> None:
        """Take the Suspensions of this process, if it has one already."""
        self._suspensions = suspensions or Suspensions()
        self._seen = self._suspensions.number()
        self._subscribers: list[Any] = []
        self._old: deque[object] = deque(maxlen=100)  # headers of old connections
        self._renewed: list[tuple[Any, Any]] = []  # (subscriber, old connection)
        self._looks_s: list[float] = []

    def watch(self, subscriber: Any) -> None:
        """Add a rospy.Subscriber whose connections to renew."""
        self._subscribers.append(subscriber)

    def notice(self) -> bool:
        """Return whether there was a suspension since the last call; call this from one thread.

        Call this regularly: it also checks the new connections.
        """
        number, now = self._suspensions.number(), time.monotonic()
        if number == self._seen:
            self._look_after(now)
            return False
        self._seen = number
        self._renewed = [(sub, link) for sub in self._subscribers for link in established(sub)]
        for subscriber, link in self._renewed:
            self._old.append(link.header)
            renew(subscriber, link)
        self._looks_s = [now + after_s for after_s in LOOKS_AFTER_S]
        return True

    def _look_after(self, now: float) -> None:
        if self._looks_s and now >= self._looks_s[0]:
            self._looks_s.pop(0)
            for subscriber, link in self._renewed:
                if not is_connected(subscriber, link):
                    renew(subscriber, link)

    def is_old(self, message: Any) -> bool:
        """Return whether the connection of a message is older than a suspension."""
        return any(header_of(message) is header for header in self._old)
