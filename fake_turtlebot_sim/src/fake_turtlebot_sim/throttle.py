"""A limit to how often something is said. Reads no clock: time enters in seconds."""

from math import inf


class Throttle:
    """Lets each text through once in a period."""

    def __init__(self, period_s):
        """Take the period [s]."""
        self._period_s = period_s
        self._said_s = {}

    def ready(self, text, now):
        """Tell whether the text may be said now [s]."""
        ready = now - self._said_s.get(text, -inf) >= self._period_s
        if ready:
            self._said_s[text] = now
        return ready
