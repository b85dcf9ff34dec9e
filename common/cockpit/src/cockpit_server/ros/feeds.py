"""Subscribes to what is looked at, and to nothing else, without ever waiting for the master.

A node of rospy has one subscription for a topic, for all its uses: here it is of raw messages,
which each listener decodes as far as needed.
"""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import Any, Callable, Hashable, Mapping

import numpy as np
import rospy

from cockpit_server.failures import Guard

PERIOD_S = 0.05  # how often a topic is read of which only the newest message is wanted
# One thread for all questions to the master that may wait: they are asked one after the other.
_worker = ThreadPoolExecutor(1, thread_name_prefix="to_the_master")
_queued: set[Callable[[], Any]] = set()  # later_once() queues each once.


def later(action: Callable[..., Any], *arguments: Any) -> None:
    """Do something that may wait for the master, in another thread; log a failure."""

    def do() -> None:
        try:
            action(*arguments)
        except Exception as error:  # whatever the master or a node answered; the next one is asked
            rospy.logwarn("cockpit: %s: %s", type(error).__name__, error)

    _worker.submit(do)


def later_once(action: Callable[[], Any]) -> None:
    """Do it later, too, but queue the same action once, however often it is requested."""

    def do() -> None:
        _queued.discard(action)
        action()

    if action not in _queued:
        _queued.add(action)
        later(do)


def read(kind: Any, data: bytes, longest: float = float("inf"), as_arrays: bool = False) -> Any:
    """Return a message of a kind from at most so many bytes; None if malformed.

    as_arrays: its lists of numbers are arrays of numpy, which is fast for a map or a scan.
    """
    with suppress(Exception):  # whatever the bytes make a message class do
        if len(data) <= longest:
            return kind().deserialize_numpy(data, np) if as_arrays else kind().deserialize(data)
    return None


class Raw(rospy.AnyMsg):
    """A message of any type, not deserialized."""

    def deserialize(self, data: bytes) -> Raw:
        self.data = data
        return self


Hear = Callable[[Raw, str], None]  # gets a message, and its topic


class Feeds:
    """The topics that are wanted now. Used by one thread, except for the messages."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._guard = Guard(report)
        # owner -> ({topic: hear}, whether every message is wanted)
        self._wants: dict[Hashable, tuple[Mapping[str, Hear], bool]] = {}
        self._listeners: dict[str, list[Hear]] = {}
        self._wanted: frozenset[tuple[str, bool]] = frozenset()  # as in _wants
        self._subscribers: dict[tuple[str, bool], Any] = {}

    def set_subscriptions(self, owner: Hashable, handlers: Mapping[str, Hear], every: bool) -> None:
        """Have hear(message, topic) called for these topics, {topic: hear}, and for no others that
        the owner wanted before. every: for every message, or only for the newest, now and then.
        """
        if self._wants.get(owner) == (handlers, every):
            return
        self._wants[owner] = (handlers, every)
        listeners: dict[str, list[Hear]] = {}
        complete: set[str] = set()
        for wanted, wants_all in self._wants.values():
            for topic, hear in wanted.items():
                listeners.setdefault(topic, []).append(hear)
            complete |= set(wanted) if wants_all else set()
        self._listeners = listeners
        self._wanted = frozenset((topic, topic in complete) for topic in listeners)
        later_once(self._adjust)

    def _adjust(self) -> None:
        wanted = self._wanted
        # A topic that rospy refuses must not hold up the others, which also show a rival.
        for key in set(self._subscribers) - wanted:
            self._guard(repr(key[0]), self._subscribers.pop(key).unregister)
        for key in wanted - set(self._subscribers):
            self._guard(repr(key[0]), self._subscribe, *key)

    def _subscribe(self, topic: str, every: bool) -> None:
        hear, queue_size = (self._hear, None) if every else (self._hear_now_and_then, 1)
        self._subscribers[topic, every] = rospy.Subscriber(topic, Raw, hear, topic, queue_size)

    def _hear(self, message: Raw, topic: str) -> None:
        for hear in self._listeners.get(topic, ()):
            hear(message, topic)

    def _hear_now_and_then(self, message: Raw, topic: str) -> None:
        # While this sleeps, rospy does not read: the kernel keeps what comes, and of that rospy
        # gives the newest. Thirty robots at 50 Hz would keep a processor busy otherwise.
        self._hear(message, topic)
        time.sleep(PERIOD_S)
