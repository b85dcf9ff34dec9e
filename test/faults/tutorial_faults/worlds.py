"""Real objects, the invariants that watch them, and a clock (pure)."""

from __future__ import annotations

import math
from typing import Any, Iterable

TICK, SUSPENDED = "tick", "suspended"  # events; a TICK: the node looks at the clock


def moves(velocity: Iterable[float]) -> bool:
    """Return whether a velocity is other than zero; NaN is, too."""
    return any(part != 0 for part in velocity)


class Moment(int):
    """A time [us] to which seconds are added without rounding: at a threshold is at it exactly."""

    __slots__ = ()

    def __add__(self, seconds: Any) -> Any:
        """Return the Moment so many seconds later, or infinity."""
        return seconds if math.isinf(seconds) else Moment(int(self) + round(seconds * 1e6))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        """Return the seconds since another Moment, or the Moment so many seconds before."""
        if isinstance(other, Moment):
            return (int(self) - int(other)) / 1e6
        return self + -other


class World:
    """Shows events to real objects, by their public interface, and judges what they answer."""

    now = Moment(0)

    def take(self, event: Any) -> None:
        """Let an event happen (a number: seconds pass).

        Raises AssertionError with the letter of an invariant that is violated, and how.
        """
        if isinstance(event, float):
            self.now += event
            return
        for letter, what in self.happen(event):
            raise AssertionError(f"({letter}) {what}, at {self.now - Moment(0):.6f} s: {event}")

    def happen(self, event: Any) -> Iterable[tuple[str, str]]:
        """Let an event happen; yield the letter of each invariant that is violated, and how."""
        raise NotImplementedError
