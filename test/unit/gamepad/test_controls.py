"""What a hand does on a gamepad, and what its axes and buttons then are."""

import pytest

from gamepad.gamepads import F710, F710_D, F710_X
from gamepad.virtual.controls import Controls, positions


def test_the_left_stick_is_on_axes_0_and_1_and_with_the_led_on_4_and_5():
    pushed = {"left_stick": (0.6, -0.25), "dpad": (0.0, 1.0)}
    assert positions(F710_D, Controls(**pushed))[0] == (0.6, -0.25, 0.0, 0.0, 0.0, 1.0)
    swapped = positions(F710_D, Controls(mode_led=True, **pushed))[0]
    assert swapped == (0.0, 1.0, 0.0, 0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("pushed", "shown"),
    [(-1.0, -1.0), (-0.51, -1.0), (-0.5, 0.0), (0.0, 0.0), (0.5, 0.0), (0.51, 1.0), (1.0, 1.0)],
)
def test_a_d_pad_knows_only_its_ends_and_the_middle(pushed, shown):
    for pad in F710.values():
        assert positions(pad, Controls(dpad=(pushed, 0.0)))[0][-2:] == (shown, 0.0)
        assert positions(pad, Controls(dpad=(0.0, pushed)))[0][-2:] == (0.0, shown)


def test_the_right_stick_and_the_right_trigger():
    moved = Controls(right_stick=(0.25, -0.75), triggers=(0.25, 0.75))
    assert positions(F710_D, moved)[0] == (0.0, 0.0, 0.25, -0.75, 0.0, 0.0)
    assert positions(F710_X, moved)[0] == (0.0, 0.0, 0.5, 0.25, -0.75, -0.5, 0.0, 0.0)
    held = [name for name, down in zip(F710_D.buttons, positions(F710_D, moved)[1]) if down]
    assert held == ["RT"]


def test_triggers_are_axes_in_x_mode_and_buttons_in_d_mode():
    pulled = Controls(triggers=(1.0, 0.0), held=frozenset(["LB"]))
    assert positions(F710_X, pulled)[0] == (0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    axes, buttons = positions(F710_D, pulled)
    assert not any(axes)
    assert [i for i, held in enumerate(buttons) if held] == [4, 6]
