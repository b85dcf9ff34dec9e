"""Subscribes to what is looked at, and to nothing else, without ever waiting for the master."""

from concurrent.futures import ThreadPoolExecutor

import rospy

# One thread for all questions to the master that may wait: they are asked one after the other.
_worker = ThreadPoolExecutor(1, thread_name_prefix="to_the_master")


def later(action, *arguments):
    """Do something that may wait for the master, in another thread; a failure is logged."""

    def do():
        try:
            action(*arguments)
        except Exception as error:  # whatever the master or a node answered; the next one is asked
            rospy.logwarn("cockpit: %s: %s", type(error).__name__, error)

    _worker.submit(do)


class Subscriptions:
    """Those that are wanted at this moment, by any key."""

    def __init__(self, subscribe):
        """subscribe: called with a key, in another thread; returns a rospy.Subscriber or None."""
        self._subscribe = subscribe
        self._wanted = frozenset()
        self._subscribers = {}

    def want(self, keys):
        """Have these, and no others; returns at once."""
        wanted = frozenset(keys)
        if wanted != self._wanted:
            self._wanted = wanted
            later(self._adjust)

    def _adjust(self):
        wanted = self._wanted
        for key in set(self._subscribers) - wanted:
            subscriber = self._subscribers.pop(key)
            if subscriber:
                subscriber.unregister()
        for key in wanted - set(self._subscribers):
            self._subscribers[key] = self._subscribe(key)


class Raw(rospy.AnyMsg):
    """A message of any type that is not read before somebody needs it. data: its bytes."""

    def deserialize(self, data):
        """Keep the bytes."""
        self.data = data
        return self
