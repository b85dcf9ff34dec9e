"""When the robots move and when the node publishes. Reads no clock: time enters as nanoseconds."""

from __future__ import annotations


class MotionClock:
    """Turns the readings of a clock that may be set back into a time that never decreases.

    It adds up how far the clock went forwards. A step backwards counts as no time at all, and so
    does a step from 0, with which ROS says that it has no time yet.
    """

    def __init__(self, reading_ns: int) -> None:
        """Start at zero, with the clock at reading_ns."""
        self._reading_ns = reading_ns
        self._elapsed_ns = 0

    def update(self, reading_ns: int) -> int:
        """Return the time [ns] that has passed, given what the clock shows now."""
        if self._reading_ns:
            self._elapsed_ns += max(0, reading_ns - self._reading_ns)
        self._reading_ns = reading_ns
        return self._elapsed_ns


class PhaseLock:
    """Deadlines a whole number of periods after one start, so that no lateness is passed on."""

    def __init__(self, period_ns: int, now_ns: int) -> None:
        """Let the first period begin now."""
        self._period_ns = period_ns
        self._last_ns = now_ns
        self.deadline_ns = now_ns

    def complete(self, now_ns: int) -> int:
        """Move the deadline past now_ns and return how many periods went by unused."""
        if now_ns < self._last_ns:  # the clock was set back
            self.deadline_ns = now_ns
        self._last_ns = now_ns
        missed = max(0, now_ns - self.deadline_ns) // self._period_ns
        self.deadline_ns += (missed + 1) * self._period_ns
        return missed
