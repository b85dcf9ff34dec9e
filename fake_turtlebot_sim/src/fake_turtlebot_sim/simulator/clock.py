"""The time of the robots' motion and of the node's cycles, from readings of a clock [ns]."""

from __future__ import annotations


class MotionClock:
    """Turns the readings of a clock that may be set back into a time that never decreases.

    It adds up the steps forwards. A step backwards counts as no time, and so does a step from 0,
    which in ROS means that the time is not known yet.
    """

    def __init__(self, reading_ns: int) -> None:
        """Start at zero, with the clock at reading_ns."""
        self._reading_ns = reading_ns
        self._elapsed_ns = 0

    def update(self, reading_ns: int) -> int:
        """Return the time [ns] since the start, at a reading of the clock."""
        if self._reading_ns:
            self._elapsed_ns += max(0, reading_ns - self._reading_ns)
        self._reading_ns = reading_ns
        return self._elapsed_ns


class PhaseLock:
    """Deadlines at whole periods after the start, so that delays do not add up."""

    def __init__(self, period_ns: int, now_ns: int) -> None:
        """Start the first period now."""
        self._period_ns = period_ns
        self._last_ns = now_ns
        self.deadline_ns = now_ns

    def complete(self, now_ns: int) -> int:
        """Move the deadline past now_ns; return the number of periods that were missed."""
        if now_ns < self._last_ns:  # the clock was set back
            self.deadline_ns = now_ns
        self._last_ns = now_ns
        missed = max(0, now_ns - self.deadline_ns) // self._period_ns
        self.deadline_ns += (missed + 1) * self._period_ns
        return missed
