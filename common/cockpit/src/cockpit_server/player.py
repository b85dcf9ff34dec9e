"""When which recorded message is due (pure)."""

from bisect import bisect_left


class Player:
    """Plays [(time since the start [s], axes, buttons)] in the order of time."""

    def __init__(self, messages, duration, rate, loop):
        """duration: of the whole recording [s]. rate: 1 is as fast as it was recorded. seek()
        begins. Everywhere here now is [s] of one clock.
        """
        self._messages, self._duration = messages, duration
        self._times = [message[0] for message in messages]
        self._rate, self._loop = rate, loop
        self._began, self._next = 0.0, 0

    def seek(self, position, now):
        """Go on from a position [s]."""
        if position >= self._duration:
            position = 0.0
        self._began = now - position / self._rate
        self._next = bisect_left(self._times, position)

    def position(self, now):
        """Where it is [s]."""
        return min(self._duration, (now - self._began) * self._rate)

    def is_over(self, now):
        """Whether all has been played."""
        return not self._loop and (now - self._began) * self._rate >= self._duration

    def due(self, now):
        """The (axes, buttons) to publish now, in their order."""
        position = (now - self._began) * self._rate
        if self._loop and position >= self._duration:
            rest = self._messages[self._next :]
            self.seek(0.0, now)
            return [message[1:] for message in rest]
        first, self._next = self._next, max(self._next, bisect_left(self._times, position))
        return [message[1:] for message in self._messages[first : self._next]]
