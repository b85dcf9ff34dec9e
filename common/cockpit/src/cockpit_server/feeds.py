"""Subscribes to what is looked at, and to nothing else, without ever waiting for the master.

A node of rospy has one subscription for a topic, whatever it wants it for: here it is of raw
messages, which each listener decodes as far as needed.
"""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rospy

from cockpit_server.guard import Guard

PERIOD_S = 0.05  # how often a topic is read of which only the newest message is wanted
# One thread for all questions to the master that may wait: they are asked one after the other.
_worker = ThreadPoolExecutor(1, thread_name_prefix="to_the_master")


def later(action, *arguments):
    """Do something that may wait for the master, in another thread; log a failure."""

    def do():
        try:
            action(*arguments)
        except Exception as error:  # whatever the master or a node answered; the next one is asked
            rospy.logwarn("cockpit: %s: %s", type(error).__name__, error)

    _worker.submit(do)


class OnceLater:
    """An action for later(), queued once however often it is requested."""

    def __init__(self, action):
        self._action = action
        self._waits = threading.Event()

    def __call__(self):
        if not self._waits.is_set():
            self._waits.set()
            later(self._do)

    def _do(self):
        self._waits.clear()
        self._action()


class Raw(rospy.AnyMsg):
    """A message of any type, not deserialized."""

    def deserialize(self, data):
        self.data = data
        return self


class Feeds:
    """The topics that are wanted now. Used by one thread, except for the messages."""

    def __init__(self, tell):
        self._guard = Guard(tell)
        self._wants = {}  # owner -> ({topic: hear}, whether every message is wanted)
        self._listeners = {}  # topic -> functions to call
        self._wanted = frozenset()  # (topic, whether every message is wanted)
        self._subscribers = {}
        self._adjust_later = OnceLater(self._adjust)

    def want(self, owner, hears, every):
        """Have hear(message, topic) called for these topics, {topic: hear}, and for no others that
        the owner wanted before. every: for every message, or only for the newest, now and then.
        """
        if self._wants.get(owner) == (hears, every):
            return
        self._wants[owner] = (hears, every)
        listeners, complete = {}, set()
        for wanted, wants_all in self._wants.values():
            for topic, hear in wanted.items():
                listeners.setdefault(topic, []).append(hear)
            complete |= set(wanted) if wants_all else set()
        self._listeners = listeners
        self._wanted = frozenset((topic, topic in complete) for topic in listeners)
        self._adjust_later()

    def _adjust(self):
        wanted = self._wanted
        # One that rospy refuses must not keep the others away, by which a rival is noticed, too.
        for key in set(self._subscribers) - wanted:
            self._guard(repr(key[0]), self._subscribers.pop(key).unregister)
        for key in wanted - set(self._subscribers):
            self._guard(repr(key[0]), self._subscribe, *key)

    def _subscribe(self, topic, every):
        if every:
            subscriber = rospy.Subscriber(topic, Raw, self._hear, topic)
        else:
            subscriber = rospy.Subscriber(topic, Raw, self._hear_now_and_then, topic, 1)
        self._subscribers[topic, every] = subscriber

    def _hear(self, message, topic):
        for hear in self._listeners.get(topic, ()):
            hear(message, topic)

    def _hear_now_and_then(self, message, topic):
        # While this sleeps, rospy does not read: the kernel keeps what comes, and of that rospy
        # gives the newest. Thirty robots at 50 Hz would keep a processor busy otherwise.
        self._hear(message, topic)
        time.sleep(PERIOD_S)
