"""What a Joy means for joy2twist, written from its documentation and not from its code (pure)."""

from __future__ import annotations

import math
from typing import Sequence

from tutorial_faults.invariants import Joy

RELEASED = 0.1  # a stick within this part of its way is released
LARGEST = 1e6  # a length of all axes beyond this is noise


class Meaning:
    """Whether a Joy is good, holds the dead-man button, has all released."""

    def __init__(
        self,
        axes: Sequence[int],
        enable: int = -1,
        turbo: int = -1,
        needs_dead_man: bool = True,
        *,
        max_age_s: float = 0.0,
        stop: int = -1,
        reset: int = -1,
    ) -> None:
        """axes: those that drive. enable, turbo, stop, reset: buttons, -1 for none.

        needs_dead_man: else every good message may move the robot. max_age_s: [s], 0 for any.
        """
        self._axes = axes
        self._dead_men = [button for button in (enable, turbo) if button >= 0]
        self._needs_dead_man = needs_dead_man
        self._stop, self._reset = stop, reset
        self._max_age_s = max_age_s or math.inf

    def is_good(self, joy: Joy) -> bool:
        """Return whether it has all axes and buttons, usable numbers, and is not too old."""
        return (
            len(joy.axes) > max(self._axes)
            and len(joy.buttons) > max([*self._dead_men, self._stop, self._reset])
            and all(map(math.isfinite, joy.axes))
            and math.hypot(*joy.axes) <= LARGEST
            and joy.age_s <= self._max_age_s
        )

    def holds(self, joy: Joy) -> bool:
        """Return whether the robot may move by it."""
        return self.is_good(joy) and (not self._needs_dead_man or self._presses(joy))

    def is_released(self, joy: Joy) -> bool:
        """Return whether it is good, with the sticks and any dead-man button released."""
        sticks = self.is_good(joy) and all(abs(joy.axes[axis]) <= RELEASED for axis in self._axes)
        return sticks and not (self._needs_dead_man and self._presses(joy))

    def stops(self, joy: Joy) -> bool:
        """Return whether the stop button is pressed, in a good or a bad message."""
        return any(joy.buttons[self._stop : self._stop + 1]) if self._stop >= 0 else False

    def resets(self, joy: Joy) -> bool:
        """Return whether it is good, with the reset button pressed and not the stop button."""
        return self.is_good(joy) and not self.stops(joy) and bool(joy.buttons[self._reset])

    def _presses(self, joy: Joy) -> bool:
        return any(joy.buttons[button] for button in self._dead_men)
