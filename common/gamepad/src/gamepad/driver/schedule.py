"""When to publish the state."""

from __future__ import annotations

import math


class Schedule:
    """Combines changes within the coalesce interval, and repeats an unchanged state.

    Times in seconds, of a clock that never jumps. due: when to publish next.
    """

    def __init__(self, coalesce_interval: float, autorepeat_rate: float) -> None:
        """Take the interval [s] and the rate [Hz], 0 for no repetition."""
        self._interval = coalesce_interval
        self._period = 1.0 / autorepeat_rate if autorepeat_rate else math.inf
        self.due = math.inf

    def soon(self, now: float) -> None:
        """Publish a change that may wait for other changes, for at most the interval.

        The time starts at the first change, so that a stick in motion is not delayed.
        """
        self.due = min(self.due, now + self._interval)

    def at_once(self, now: float) -> None:
        """Publish a change at once."""
        self.due = min(self.due, now)

    def published(self, now: float) -> None:
        """Record that the state was published."""
        self.due = now + self._period
