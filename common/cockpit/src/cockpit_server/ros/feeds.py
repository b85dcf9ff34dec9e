"""Subscribes to the topics that tabs need, and to no others, without ever waiting for the master.

rospy makes one subscription of a topic for all its uses, so this one receives raw messages, which
each tab decodes as far as it needs.
"""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Hashable, Mapping

import rospy

from cockpit_server.failures import Guard
from cockpit_server.messages import Handler, ReceivedMessage
from node_kit.ros.rospy_patches.connections import sender_of

PERIOD_S = 0.05  # between two messages of a topic of which only the newest is needed
# The one thread for calls of the master that may block: they are made one after the other.
_worker = ThreadPoolExecutor(1, thread_name_prefix="to_the_master")
_queued: set[Callable[[], Any]] = set()  # later_once() queues an action once.


def later(action: Callable[..., Any], *arguments: Any) -> None:
    """Do something that may wait for the master, in another thread; log a failure."""

    def do() -> None:
        try:
            action(*arguments)
        except Exception as error:  # whatever the master or a node answered; the next call is made
            rospy.logwarn("cockpit: %s: %s", type(error).__name__, error)

    _worker.submit(do)


def later_once(action: Callable[[], Any]) -> None:
    """Do an action as later() does, but queue it once, however often it is requested."""

    def do() -> None:
        _queued.discard(action)
        action()

    if action not in _queued:
        _queued.add(action)
        later(do)


class _Undecoded(rospy.AnyMsg):
    def deserialize(self, data: bytes) -> _Undecoded:
        self.data = data
        return self


class Feeds:
    """The topics that are needed now. One thread sets them; messages arrive in rospy's threads."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._guard = Guard(report)
        # owner -> ({topic: handler}, whether every message is needed)
        self._wants: dict[Hashable, tuple[Mapping[str, Handler], bool]] = {}
        self._handlers: dict[str, list[Handler]] = {}
        self._wanted: frozenset[tuple[str, bool]] = frozenset()  # as in _wants
        # Not wanted for a moment since the last _adjust(). If it is wanted again, there is a new
        # subscription, as its user expects what is latched.
        self._dropped: set[tuple[str, bool]] = set()
        self._subscribers: dict[tuple[str, bool], Any] = {}

    def set_subscriptions(
        self, owner: Hashable, handlers: Mapping[str, Handler], every: bool
    ) -> None:
        """Subscribe an owner to the topics of {topic: handler}, and to no others.

        The handlers of a topic are called by one thread at a time, with every message or only with
        the newest, at intervals.
        """
        if self._wants.get(owner) == (handlers, every):
            return
        self._wants[owner] = (handlers, every)
        by_topic: dict[str, list[Handler]] = {}
        complete: set[str] = set()
        for wanted, wants_all in self._wants.values():
            for topic, handler in wanted.items():
                by_topic.setdefault(topic, []).append(handler)
            complete |= set(wanted) if wants_all else set()
        self._handlers = by_topic
        keys = frozenset((topic, topic in complete) for topic in by_topic)
        self._dropped.update(self._wanted - keys)
        self._wanted = keys
        later_once(self._adjust)

    def _adjust(self) -> None:
        wanted = self._wanted
        # A topic that rospy refuses must not affect the others, which also reveal a rival.
        for key in [key for key in self._subscribers if key in self._dropped or key not in wanted]:
            self._dropped.discard(key)
            self._guard(repr(key[0]), self._subscribers.pop(key).unregister)
        for key in wanted - set(self._subscribers):
            self._guard(repr(key[0]), self._subscribe, *key)

    def _subscribe(self, topic: str, every: bool) -> None:
        callback, queue_size = (self._receive, None) if every else (self._receive_at_intervals, 1)
        about = topic, threading.Lock()  # Each publisher of the topic has a thread.
        self._subscribers[topic, every] = rospy.Subscriber(
            topic, _Undecoded, callback, about, queue_size
        )

    def _receive(self, message: _Undecoded, about: tuple[str, threading.Lock]) -> None:
        topic, lock = about
        raw = ReceivedMessage(topic, message.data, sender_of(message), time.monotonic())
        with lock:
            for handler in self._handlers.get(topic, ()):
                handler(raw)

    def _receive_at_intervals(self, message: _Undecoded, about: tuple[str, threading.Lock]) -> None:
        # While this sleeps, rospy does not read: the kernel buffers what arrives, and rospy then
        # passes on the newest. Thirty robots at 50 Hz would keep a processor busy otherwise.
        self._receive(message, about)
        time.sleep(PERIOD_S)
