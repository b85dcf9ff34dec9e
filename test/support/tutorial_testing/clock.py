"""A clock that a test sets."""


class Clock:
    """In the place of the module time: the time, and how long this thread has worked [s]."""

    def __init__(self, now=0.0):
        self.now, self.worked = now, 0.0

    def monotonic(self):
        return self.now

    def thread_time(self):
        return self.worked
