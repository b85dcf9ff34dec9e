"""When the state is published (pure)."""

from __future__ import annotations

import math


class Schedule:
    """Joins what happens within the coalesce interval, and repeats what stays the same.

    All times are in seconds, of one clock that never jumps. due: when to publish next.
    """

    def __init__(self, coalesce_interval: float, autorepeat_rate: float) -> None:
        """Take the interval [s] and the rate [Hz], 0 for no repetition."""
        self._interval = coalesce_interval
        self._period = 1.0 / autorepeat_rate if autorepeat_rate else math.inf
        self.due = math.inf

    def soon(self, now: float) -> None:
        """Publish a change that may wait for other changes, but no longer than the interval.

        The time runs from the first change, so that a stick that never rests is not kept back.
        """
        self.due = min(self.due, now + self._interval)

    def at_once(self, now: float) -> None:
        """Publish a change that may not wait."""
        self.due = min(self.due, now)

    def published(self, now: float) -> None:
        """Note that the state was published, with everything up to now."""
        self.due = now + self._period
