"""Ignores what was sent to a node while its process was suspended."""

from __future__ import annotations

from collections import deque
from typing import Any

from node_kit.careful_connections import header_of, renew
from node_kit.suspension import Suspensions


class FreshOnly:
    """Renews the connections of a node's subscribers after a suspension.

    What waits in the old ones is never read. A program that goes on sending is obeyed again as soon
    as it is connected anew. A hold-to-run style publisher finds a subscriber that is new, which it
    drives only once all was released (prompt_publisher.VelocityPublisher).
    """

    def __init__(self, suspensions: Suspensions | None = None) -> None:
        """Take the Suspensions of this process, if it has them already."""
        self._suspensions = suspensions or Suspensions()
        self._seen = self._suspensions.number()
        self._old: deque[object] = deque(maxlen=100)
        self._subscribers: list[Any] = []

    def watch(self, subscriber: Any) -> None:
        """Renew the connections of this rospy.Subscriber, too."""
        self._subscribers.append(subscriber)

    def notice(self) -> bool:
        """Return whether there was a suspension since the last call; one thread at a time."""
        number = self._suspensions.number()
        if number == self._seen:
            return False
        self._seen = number
        for subscriber in self._subscribers:
            self._old += renew(subscriber)
        return True

    def is_old(self, message: Any) -> bool:
        """Return whether a message came by a connection from before a suspension."""
        return any(header_of(message) is one for one in self._old)
