"""From a position of hands on a gamepad to its axes and buttons."""

import pytest

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.controls import Controls, positions

PUSHED = {"left_stick": (0.6, -0.25), "dpad": (0.0, 1.0)}
RIGHT = {"right_stick": (0.25, -0.75), "triggers": (0.25, 0.75)}


@pytest.mark.parametrize(
    ("pad", "moved", "axes", "held"),
    [
        (F710_D, {}, (0, 0, 0, 0, 0, 0), []),
        (F710_X, {}, (0, 0, 1, 0, 0, 1, 0, 0), []),
        (F710_D, PUSHED, (0.6, -0.25, 0, 0, 0, 1), []),
        (F710_D, {**PUSHED, "mode_led": True}, (0, 1, 0, 0, 1, 0), []),
        (F710_D, RIGHT, (0, 0, 0.25, -0.75, 0, 0), ["RT"]),
        (F710_D, {"triggers": (1.0, 0.5), "held": {"LB"}}, (0, 0, 0, 0, 0, 0), ["LB", "LT"]),
        (F710_X, {"triggers": (1.0, 0.0), "held": {"A"}}, (0, 0, -1, 0, 0, 1, 0, 0), ["A"]),
    ],
)
def test_axes_and_buttons(pad, moved, axes, held):
    shown, buttons = positions(pad, Controls(**moved))
    assert shown == axes
    assert [name for name, down in zip(pad.buttons, buttons) if down] == held
