"""Ignores what was sent to a node while its process was suspended."""

from __future__ import annotations

import time
from collections import deque
from typing import Any

from node_kit.io.suspension import Suspensions
from node_kit.ros.rospy_patches.connections import established, header_of, is_connected, renew

# After a renewal [s]: rospy gives a connection up for good if its greeting fails once, as it may do
# for a while on a machine that is busy.
LOOKS_AFTER_S = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0)


class FreshOnly:
    """Renews the connections of a node's subscribers after a suspension.

    What waits in the old ones is never read. A program that goes on sending is obeyed again as soon
    as it is connected again. A hold-to-run style publisher finds a subscriber that is new, which it
    drives only once all was released (prompt_publisher.VelocityPublisher).
    """

    def __init__(self, suspensions: Suspensions | None = None) -> None:
        """Take the Suspensions of this process, if it has them already."""
        self._suspensions = suspensions or Suspensions()
        self._seen = self._suspensions.number()
        self._subscribers: list[Any] = []
        self._old: deque[object] = deque(maxlen=100)  # headers of old connections
        self._renewed: list[tuple[Any, Any]] = []  # (subscriber, old connection)
        self._looks_s: list[float] = []

    def watch(self, subscriber: Any) -> None:
        """Renew the connections of this rospy.Subscriber, too."""
        self._subscribers.append(subscriber)

    def notice(self) -> bool:
        """Return whether there was a suspension since the last call; one thread at a time.

        Call it now and then: it looks after the new connections, too.
        """
        number, now = self._suspensions.number(), time.monotonic()
        if number == self._seen:
            self._look_after(now)
            return False
        self._seen = number
        self._renewed = [(each, one) for each in self._subscribers for one in established(each)]
        for subscriber, one in self._renewed:
            self._old.append(one.header)
            renew(subscriber, one)
        self._looks_s = [now + after_s for after_s in LOOKS_AFTER_S]
        return True

    def _look_after(self, now: float) -> None:
        if self._looks_s and now >= self._looks_s[0]:
            self._looks_s.pop(0)
            for subscriber, one in self._renewed:
                if not is_connected(subscriber, one):
                    renew(subscriber, one)

    def is_old(self, message: Any) -> bool:
        """Return whether a message came by a connection from before a suspension."""
        return any(header_of(message) is one for one in self._old)
