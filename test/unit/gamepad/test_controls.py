"""What a hand does on a gamepad, and what its axes and buttons then are."""

import pytest

from gamepad.gamepads import F710, F710_D, F710_X
from gamepad.virtual.controls import Controls, check_controls, positions


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


def test_a_trigger_half_way_is_not_pulled():
    halfway = positions(F710_D, Controls(triggers=(0.5, 0.51)))[1]
    assert (halfway[6], halfway[7]) == (0, 1)


def test_an_untouched_gamepad_shows_zeros_and_in_x_mode_two_released_triggers():
    assert positions(F710_D, Controls()) == ((0.0,) * 6, (0,) * 12)
    assert positions(F710_X, Controls()) == ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), (0,) * 11)
    assert Controls().plugged and not Controls().mode_led


def test_a_position_never_changes_so_that_one_can_be_kept():
    assert {Controls(): "untouched"}[Controls(held=frozenset())] == "untouched"
    with pytest.raises(AttributeError):
        Controls().plugged = False


@pytest.mark.parametrize("part", ["left_stick", "right_stick", "dpad", "triggers"])
def test_both_numbers_of_a_part_are_checked(part):
    low = 0 if part == "triggers" else -1
    for allowed in ([low, 1], [1, low], [0, 0.25], [1.0, low + 0.5]):
        check_controls(Controls(**{part: allowed}), "D")
    for wrong in ([low - 0.5, 0], [0, low - 0.5], [1.5, 0], [0, 1.5], [0], [], [0, 0, 0]):
        with pytest.raises(ValueError) as error:
            check_controls(Controls(**{part: wrong}), "D")
        assert str(error.value) == f"{part} is {wrong}; allowed are two numbers from {low} to 1"
    for wrong in ([0, "x"], ["x", 0], [0, 0, "x"], [0, float("nan")], [None, 0]):
        with pytest.raises(ValueError, match=f"^{part} is "):
            check_controls(Controls(**{part: wrong}), "D")


def test_only_buttons_of_the_mode_can_be_held():
    for mode, pad in F710.items():
        check_controls(Controls(held=frozenset(pad.buttons)), mode)
    for held, mode, line in (
        (["LOGITECH"], "D", "'LOGITECH' is no button in D mode: X, A, B, Y, LB, RB, LT, RT, "),
        (["A", "LT", "C", 7], "X", "7 is no button in X mode: A, B, X, Y, LB, RB, BACK, START, "),
    ):
        with pytest.raises(ValueError) as error:
            check_controls(Controls(held=frozenset(held)), mode)
        assert str(error.value).startswith(line)
