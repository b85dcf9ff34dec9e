"""From events to axes and buttons, by the rules of ROS Noetic's joy_node (pure)."""

from gamepad.gamepads import triggers_by_count
from gamepad.js_event import AXIS, BUTTON, FULL, INIT

# What an event asks for.
NOTHING = 0  # it is of an unknown type
SOON = 1  # publish together with others that come shortly after it
NOW = 2  # publish at once

LARGEST_DEADZONE = 0.9  # a wider one is taken as this, as upstream does


class GamepadState:
    """The axes and buttons of one gamepad since it was opened.

    Signs are those of ROS: left and up are positive, where the kernel has right and down.
    """

    def __init__(self, deadzone, default_trig_val, sticky_buttons):
        """See driver_parameters.DriverParameters.

        deadzone: this part of the way of an axis around its middle counts as 0; the rest is
        stretched over the whole range. default_trig_val: take the values of axes at opening; else
        an axis is 0 until it moves. sticky_buttons: a press switches a button on or off.
        """
        deadzone = min(deadzone, LARGEST_DEADZONE)
        self._dead = FULL * deadzone
        self._scale = -1.0 / (1.0 - deadzone) / FULL
        self._take_initial_axes = default_trig_val
        self._sticky = sticky_buttons
        self._axes = []
        self._buttons = []
        self._published = []  # buttons when published last
        self._switched = []  # the sticky buttons

    def apply(self, event):
        """Take in a js_event.JsEvent; returns NOTHING, SOON or NOW."""
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

    def knows(self, event):
        """Whether the axis or button of a js_event.JsEvent was told before."""
        known = {BUTTON: self._buttons, AXIS: self._axes}.get(event.type & ~INIT, ())
        return event.number < len(known)

    def publish(self):
        """(axes, buttons) for a message: tuples of floats and of 0 and 1."""
        if not self._sticky:
            return tuple(self._axes), tuple(self._buttons)
        for states in (self._published, self._switched):
            states.extend([0] * (len(self._buttons) - len(states)))
        for i, pressed in enumerate(self._buttons):
            if pressed and not self._published[i]:
                self._switched[i] = 1 - self._switched[i]
        self._published = list(self._buttons)
        return tuple(self._axes), tuple(self._switched)

    def neutral(self, triggers):
        """(axes, buttons) as if nobody touched the gamepad.

        triggers: the numbers of the axes that are triggers; None if unknown.
        """
        if triggers is None:
            triggers = triggers_by_count(len(self._axes))
        # A trigger at rest reads +1.
        axes = tuple([1.0 if i in triggers else 0.0 for i in range(len(self._axes))])
        return axes, (0,) * len(self._buttons)

    def _position(self, value):
        if value > self._dead:
            value -= self._dead
        elif value < -self._dead:
            value += self._dead
        else:
            return 0.0
        return value * self._scale


def _grow(values, number):
    """Make room for a number; what was skipped is 0."""
    values.extend([0] * (number + 1 - len(values)))


def _put(values, number, value):
    _grow(values, number)
    values[number] = value
