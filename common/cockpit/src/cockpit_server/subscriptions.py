"""Subscribes to what is looked at, and to nothing else, without ever waiting for the master."""

from concurrent.futures import ThreadPoolExecutor

# One thread for all questions to the master that may wait: they are asked one after the other.
worker = ThreadPoolExecutor(1, thread_name_prefix="to_the_master")


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
            worker.submit(self._adjust)

    def _adjust(self):
        wanted = self._wanted
        for key in set(self._subscribers) - wanted:
            subscriber = self._subscribers.pop(key)
            if subscriber:
                subscriber.unregister()
        for key in wanted - set(self._subscribers):
            self._subscribers[key] = self._subscribe(key)
