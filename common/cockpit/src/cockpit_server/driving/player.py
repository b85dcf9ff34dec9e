"""Plays a recording: which messages are due at a time."""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, Callable, Sequence, Tuple

Message = Tuple[float, Callable[[Any], object], Any]


class Player:
    """A recording that plays: messages (time since the start [s], what publishes it, its data)."""

    def __init__(self, duration: float, rate: float, loop: bool, position: float = 0.0) -> None:
        """position: where it starts once it is loaded."""
        self._duration, self._rate, self._loop = duration, rate, loop
        self._messages: Sequence[Message] = ()
        self._times: list[float] = []
        self._ends: Sequence[Callable[[], object]] = ()
        self._is_loaded = False
        self.seek(position, 0.0)

    def load(
        self, messages: Sequence[Message], ends: Sequence[Callable[[], object]], now: float
    ) -> None:
        """Begin to play. ends: called by end(); they stop what the messages move."""
        self._messages, self._ends = messages, ends
        self._times = [message[0] for message in messages]
        self._is_loaded = True
        self.seek(self._start, now)

    def end(self) -> None:
        for end in self._ends:
            end()

    def seek(self, position: float, now: float) -> None:
        self._start = 0.0 if position >= self._duration else position
        self._began = now - self._start / self._rate
        self._next = bisect_left(self._times, self._start)

    def position(self, now: float) -> float:
        """Return the position in the recording [s]; after its end 0, from where it plays again."""
        if not self._is_loaded:
            return self._start
        return 0.0 if self.is_over(now) else min(self._duration, (now - self._began) * self._rate)

    def is_over(self, now: float) -> bool:
        has_ended = (now - self._began) * self._rate >= self._duration
        return self._is_loaded and not self._loop and has_ended

    def due(self, now: float) -> Sequence[tuple[Any, ...]]:
        """Return (what publishes it, its data) of each message to publish now, in order."""
        position = (now - self._began) * self._rate
        if not self._is_loaded:
            return ()
        if self._loop and position >= self._duration:
            rest = self._messages[self._next :]
            self.seek(0.0, now)
            return [message[1:] for message in rest]
        first, self._next = self._next, max(self._next, bisect_left(self._times, position))
        return [message[1:] for message in self._messages[first : self._next]]
