"""Limits how often something happens."""

from __future__ import annotations


class Throttle:
    """Allows an event `rate` times a second on average, and up to `burst` times at once.

    With a burst, all events of a series pass that comes at the rate, but not evenly.
    """

    def __init__(self, rate: float, burst: float = 1.0) -> None:
        """Take the rate [1/s], 0 for never, and the burst, at least 1."""
        self._period = rate and 1.0 / rate
        self._slack = (burst - 1.0) * self._period
        self._next: float | None = None  # when the next event of an even series is due [s]

    def ready(self, now: float) -> bool:
        """Return whether the event may happen at the time now [s]."""
        if not self._period:
            return False
        if self._next is None or now > self._next:
            self._next = now
        elif now < self._next - self._slack:
            return False
        self._next += self._period
        return True


class ThrottleEach:
    """One Throttle for each text."""

    def __init__(self, rate: float) -> None:
        """Take the rate [1/s] for each text."""
        self._rate = rate
        self._throttles: dict[str, Throttle] = {}

    def ready(self, text: str, now: float) -> bool:
        """Return whether the text may be reported at the time now [s]."""
        return self._throttles.setdefault(text, Throttle(self._rate)).ready(now)
