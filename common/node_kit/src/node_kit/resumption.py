"""What to make of the messages that come after a suspension (pure)."""

SETTLING_S = 0.25  # by then a process that goes on has read what was sent to it meanwhile


class Resumption:
    """What one receiver makes of suspensions. Times in seconds of any clock that goes on.

    After a suspension it takes nothing for SETTLING_S, and then, where a stop is asked for, nothing
    before one.
    """

    def __init__(self):
        """Nothing has happened yet."""
        self._seen = 0
        self._settled_at = 0.0
        self._needs_stop = False

    def notice(self, number, now):
        """Whether a suspension is new. number: of suspensions so far."""
        if number == self._seen:
            return False
        self._seen = number
        self._settled_at = now + SETTLING_S
        self._needs_stop = True
        return True

    def is_old(self, now):
        """Whether what comes now was sent during the suspension."""
        return now < self._settled_at

    def holds(self, stops, now):
        """Whether a command that comes now is not to be obeyed. stops: whether it is a stop."""
        if self.is_old(now):
            return not stops
        self._needs_stop = self._needs_stop and not stops
        return self._needs_stop
