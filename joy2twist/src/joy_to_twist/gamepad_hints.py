"""Detects from the messages that a gamepad is in another mode than expected."""

from __future__ import annotations

from typing import Sequence

from joy_to_twist.parameters import Parameters
from node_kit.rules.released import RELEASED_AXIS

# The Logitech F710 in D mode has 6 axes; with its MODE LED on, the left stick and the D-pad swap,
# so that the stick moves axes 4 and 5. Source: the tutorial's "Gamepad F710 Setup Memo".
D_MODE_AXES = 6
SWAPPED_STICK = {4, 5}


class GamepadHints:
    """Checks the first messages, and returns one line of help for each problem."""

    def __init__(self, parameters: Parameters) -> None:
        self._expected = parameters.gamepad_axes
        self._used = {axis.index for axis in parameters.axes}
        self._count: int | None = None  # the number of axes in the last message
        self._look_for_swap = False
        self._turbo = parameters.enable_turbo_button
        self._buttons: int | None = None  # the number of buttons in the last message

    def hint(self, axes: Sequence[float], buttons: Sequence[int]) -> str | None:
        """Return one line on what to do, or None."""
        if len(buttons) != self._buttons:
            self._buttons = len(buttons)
            if self._turbo >= self._buttons:
                return (
                    f"The gamepad has no button {self._turbo} (~enable_turbo_button): it has "
                    f"{self._buttons} buttons. That button counts as not pressed."
                )
        if len(axes) != self._count:
            self._count = len(axes)
            self._look_for_swap = self._count == D_MODE_AXES and not SWAPPED_STICK & self._used
            if self._expected not in (-1, self._count):
                return (
                    f"The gamepad has {self._count} axes and not {self._expected}: "
                    "check the D/X switch of a Logitech F710, or choose another joy_config."
                )
        if not self._look_for_swap:
            return None
        moved = {i for i, axis in enumerate(axes) if abs(axis) > RELEASED_AXIS}
        self._look_for_swap = not moved & (self._used | SWAPPED_STICK)
        if self._look_for_swap or moved & self._used:
            return None  # nothing has moved yet, or the stick is where it should be
        # A D-pad moves these axes too, and the swapped stick gives the same values: -1, 0 and 1.
        return (
            "Only axes 4 and 5 move: if that was the left stick of a Logitech F710, "
            "press MODE so that its LED goes off."
        )
