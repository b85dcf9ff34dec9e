"""Plays a recording: which messages are due at a time."""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, Sequence, Tuple

Message = Tuple[float, Any, Any]


class Player:
    """A recording that plays: messages (time since the start [s], axes, buttons)."""

    def __init__(
        self, messages: Sequence[Message], duration: float, rate: float, loop: bool
    ) -> None:
        self._messages, self._duration = messages, duration
        self._times = [message[0] for message in messages]
        self._rate, self._loop = rate, loop
        self._began, self._next = 0.0, 0

    def seek(self, position: float, now: float) -> None:
        if position >= self._duration:
            position = 0.0
        self._began = now - position / self._rate
        self._next = bisect_left(self._times, position)

    def position(self, now: float) -> float:
        """Return the position in the recording [s]; after its end 0, from where it plays again."""
        return 0.0 if self.is_over(now) else min(self._duration, (now - self._began) * self._rate)

    def is_over(self, now: float) -> bool:
        return not self._loop and (now - self._began) * self._rate >= self._duration

    def due(self, now: float) -> list[tuple[Any, Any]]:
        """Return the (axes, buttons) to publish now, in order."""
        position = (now - self._began) * self._rate
        if self._loop and position >= self._duration:
            rest = self._messages[self._next :]
            self.seek(0.0, now)
            return [message[1:] for message in rest]
        first, self._next = self._next, max(self._next, bisect_left(self._times, position))
        return [message[1:] for message in self._messages[first : self._next]]
