"""When the robots move and when the node publishes. Reads no clock: time enters as nanoseconds."""


class MotionClock:
    """Turns the readings of a clock that may be set back into a time that never decreases.

    While the clock is behind where it was, motion stands still for the length of the jump and
    no longer: what counts is how far the clock went forwards.
    """

    def __init__(self, reading_ns):
        """Start at zero, with the clock at reading_ns."""
        self._reading_ns = reading_ns
        self._elapsed_ns = 0

    def update(self, reading_ns):
        """Return the time [ns] that has passed, given what the clock shows now."""
        self._elapsed_ns += max(0, reading_ns - self._reading_ns)
        self._reading_ns = reading_ns
        return self._elapsed_ns


class PhaseLock:
    """Periods counted from one start, so that a late wake-up does not delay the later ones."""

    def __init__(self, period_ns, start_ns):
        """Let the first period begin at start_ns."""
        self._period_ns = period_ns
        self.restart(start_ns)

    def restart(self, start_ns):
        """Count from start_ns, as after a jump of the clock; the next deadline is there."""
        self.deadline_ns = start_ns

    def complete(self, now_ns):
        """Move the deadline past now_ns and return how many whole periods went by unused."""
        passed = max(0, now_ns - self.deadline_ns) // self._period_ns
        self.deadline_ns += (passed + 1) * self._period_ns
        return passed
