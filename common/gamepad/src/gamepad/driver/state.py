"""From events to axes and buttons, by the rules of ROS Noetic's joy_node."""

from __future__ import annotations

from typing import Any, Iterable, Tuple

from gamepad.gamepads import triggers_by_count
from gamepad.js_event import AXIS, BUTTON, FULL, INIT, JsEvent

# What to do after an event.
NOTHING = 0  # its type is unknown; the only value that is false
SOON = 1  # publish together with other events that follow shortly
NOW = 2  # publish at once

LARGEST_DEADZONE = 0.9  # the limit, as upstream has it


Message = Tuple[Tuple[float, ...], Tuple[int, ...]]  # axes and buttons


class GamepadState:
    """The axes and buttons of one gamepad since it was opened.

    Signs are those of ROS: left and up are positive, while the kernel has right and down.
    """

    def __init__(self, deadzone: float, default_trig_val: bool, sticky_buttons: bool) -> None:
        """Take the values of these DriverParameters."""
        deadzone = min(deadzone, LARGEST_DEADZONE)
        self._dead = FULL * deadzone
        self._scale = -1.0 / (1.0 - deadzone) / FULL
        self._take_initial_axes = default_trig_val
        self._sticky = sticky_buttons
        self._axes: list[float] = []
        self._buttons: list[int] = []
        self._published: list[int] = []  # buttons in the last message
        self._switched: list[int] = []  # the sticky buttons

    def apply(self, event: JsEvent) -> int:
        """Apply an event; return NOTHING, SOON or NOW."""
        kind, initial = event.type & ~INIT, event.type & INIT
        if kind == BUTTON:
            _put(self._buttons, event.number, int(event.value != 0))
            return SOON if initial else NOW
        if kind == AXIS:
            if initial and not self._take_initial_axes:
                _grow(self._axes, event.number)
            else:
                _put(self._axes, event.number, self._position(event.value))
            return SOON
        return NOTHING

    def knows(self, event: JsEvent) -> bool:
        """Return whether the axis or button of an event was reported before."""
        known: Any = {BUTTON: self._buttons, AXIS: self._axes}.get(event.type & ~INIT, ())
        return bool(event.number < len(known))

    def publish(self) -> Message:
        """Return (axes, buttons) for a message: tuples of floats and of 0 and 1."""
        if not self._sticky:
            return tuple(self._axes), tuple(self._buttons)
        for states in (self._published, self._switched):
            states.extend([0] * (len(self._buttons) - len(states)))
        for i, pressed in enumerate(self._buttons):
            if pressed and not self._published[i]:
                self._switched[i] = 1 - self._switched[i]
        self._published = list(self._buttons)
        return tuple(self._axes), tuple(self._switched)

    def neutral(self, triggers: Iterable[int] | None) -> Message:
        """Return (axes, buttons) at rest; triggers: the numbers of those axes, None if unknown."""
        if triggers is None:
            triggers = triggers_by_count(len(self._axes))
        # A trigger at rest reads +1.
        axes = tuple([1.0 if i in triggers else 0.0 for i in range(len(self._axes))])
        return axes, (0,) * len(self._buttons)

    def _position(self, value: float) -> float:
        if value > self._dead:
            value -= self._dead
        elif value < -self._dead:
            value += self._dead
        else:
            return 0.0
        return value * self._scale


def _grow(values: list[Any], number: int) -> None:
    """Extend the list up to an index, with zeros."""
    values.extend([0] * (number + 1 - len(values)))


def _put(values: list[Any], number: int, value: float) -> None:
    _grow(values, number)
    values[number] = value
