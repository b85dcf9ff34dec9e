"""The virtual gamepad without a kernel: keys, moves and recordings in, axes and buttons out."""

import math
import os
from pathlib import Path

import pytest
import yaml

from gamepad.gamepads import F710, F710_D, F710_X, mode_hint, trigger_axes
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.keyboard import FIRST_HOLD_S, REPEAT_HOLD_S, Keyboard
from gamepad.virtual.moves import load_script
from gamepad.virtual.pads import PadError, StreamPad
from gamepad.virtual.sources import recording_source, script_source

# ----------------------------------------------------------------------------------- the gamepad


def test_axes_and_buttons_of_both_modes():
    assert (len(F710_D.axes), len(F710_D.buttons), F710_D.usb_id) == (6, 12, "046d:c219")
    assert (len(F710_X.axes), len(F710_X.buttons), F710_X.usb_id) == (8, 11, "046d:c21f")
    for pad in F710.values():
        assert (pad.buttons.index("LB"), pad.buttons.index("RB")) == (4, 5)
        assert len(pad.buttons) == len(pad.button_codes)


def test_triggers_are_told_from_the_right_stick():
    assert F710_D.triggers == ()
    assert F710_X.triggers == (2, 5)
    assert trigger_axes([0, 1, 3, 4, 2, 5]) == (4, 5)


@pytest.mark.parametrize("pad", F710.values(), ids=F710)
def test_the_ends_and_the_middle_of_every_axis(pad):
    for axis in pad.axes:
        ends = [axis.js_value(axis.raw(position)) for position in (1.0, -1.0)]
        assert ends == [-32767, 32767]
        assert axis.js_value(axis.raw(0.0)) == 0


def test_the_kernels_steps_between():
    # By hand from joydev_correct(): 64 * ((1 << 29) // 127) >> 14
    assert F710_D.axes[0].js_value(127 + 64) == 16513
    assert F710_D.axes[0].js_value(127 - 64) == -16514
    assert F710_X.axes[0].js_value(-16384) == -16384


def test_hints_by_usb_id():
    assert "D mode" in mode_hint("046d:c219")
    assert "X mode" in mode_hint("046d:c21f")
    assert mode_hint("045e:028e") is None


# ---------------------------------------------------------------------------------- the controls


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


# ---------------------------------------------------------------------------------- the keyboard


def at(keyboard, now):
    controls, _ = keyboard.at(now)
    return controls.left_stick, sorted(controls.held)


def test_a_key_that_is_not_repeated_is_released():
    keyboard = Keyboard()
    keyboard.press("w", 1.0)
    assert keyboard.at(1.0)[1] == 1.0 + FIRST_HOLD_S
    assert at(keyboard, 1.0 + FIRST_HOLD_S - 0.01) == ((0, 1), [])
    assert at(keyboard, 1.0 + FIRST_HOLD_S) == ((0, 0), [])
    assert keyboard.at(9.0)[1] == math.inf


@pytest.mark.parametrize(
    ("keys", "stick"),
    [
        ("w W \x1b[A \x1bOA", (0, 1)),
        ("s S \x1b[B \x1bOB", (0, -1)),
        ("a A \x1b[D \x1bOD", (1, 0)),
        ("d D \x1b[C \x1bOC", (-1, 0)),
    ],
)
def test_every_key_of_a_direction(keys, stick):
    for key in keys.split():
        keyboard = Keyboard()
        keyboard.press(key, 1.0)
        assert at(keyboard, 1.0) == (stick, []), key


@pytest.mark.parametrize(("key", "held"), [(" ", ["LB"]), ("t", ["RB"]), ("T", ["RB"])])
def test_every_key_of_a_button(key, held):
    keyboard = Keyboard()
    keyboard.press(key, 1.0)
    assert at(keyboard, 1.0) == ((0, 0), held)


@pytest.mark.parametrize("key", ["q", "Q", "\x03", "\x04"])
def test_every_key_that_quits(key):
    keyboard = Keyboard()
    keyboard.press(key, 1.0)
    assert keyboard.quit


@pytest.mark.parametrize("digit", range(10))
def test_every_digit(digit):
    keyboard = Keyboard()
    keyboard.press(f"{digit}w", 1.0)
    assert at(keyboard, 1.0) == ((0, digit / 10 if digit else 1.0), [])


def test_how_long_a_key_counts_as_held():
    assert 0.66 < FIRST_HOLD_S < 1.0  # the slowest terminal waits that long
    assert 1 / 11 < REPEAT_HOLD_S < 0.5  # the slowest repetition; joy2twist's ~joy_timeout


def test_a_second_m_and_a_second_u_undo_the_first():
    keyboard = Keyboard()
    keyboard.press("mumu", 0.0)
    assert keyboard.at(0.0)[0] == Controls()


def test_a_held_key_is_released_soon_after_its_last_repetition():
    keyboard = Keyboard()
    for repetition in range(20):
        keyboard.press("\x1b[A", 1.0 + repetition * 0.04)
        assert at(keyboard, 1.0 + repetition * 0.04) == ((0, 1), [])
    assert at(keyboard, 1.76 + REPEAT_HOLD_S + 0.001) == ((0, 0), [])


def test_the_dead_man_stays_held_while_a_later_key_repeats():
    keyboard = Keyboard()
    keyboard.press(" ", 0.0)
    for repetition in range(100):
        keyboard.press("w", 0.5 + repetition * 0.04)
    assert at(keyboard, 4.5) == ((0, 1), ["LB"])
    assert at(keyboard, 4.46 + REPEAT_HOLD_S + 0.001) == ((0, 0), [])


def test_two_directions_add_up_and_opposite_ones_replace_each_other():
    keyboard = Keyboard()
    keyboard.press("5wa", 0.0)
    assert at(keyboard, 0.0) == ((0.5, 0.5), [])
    keyboard.press("d\x1bOB", 0.1)
    assert at(keyboard, 0.1) == ((-0.5, -0.5), [])
    keyboard.press("0", 0.2)
    assert at(keyboard, 0.2) == ((-1, -1), [])


def test_mode_unplug_and_quit():
    keyboard = Keyboard()
    keyboard.press("MU", 0.0)
    controls, _ = keyboard.at(0.0)
    assert controls.mode_led and not controls.plugged
    assert not keyboard.quit
    keyboard.press("xyz\x1b[9q", 0.0)
    assert keyboard.quit


# ------------------------------------------------------------------------------------- the moves


def test_a_script_is_followed_in_time():
    script = load_script(
        {
            "moves": [
                {"for": 1},
                {"for": 2.0, "held": ["LB"], "left_stick": [0.0, 0.5]},
                {"for": 1.0, "plugged": False},
            ]
        }
    )
    source = script_source(F710_D, script, loop=False)
    rest = ((0.0,) * 6, (0,) * 12)
    assert source.at(10.0) == (rest, 11.0)
    (axes, buttons), until = source.at(11.0)
    assert (axes[1], buttons[4], until) == (0.5, 1, 13.0)
    assert source.at(13.5) == (None, 14.0)
    assert source.at(14.0) is None


def test_a_looped_script_begins_again():
    script = load_script({"mode": "X", "moves": [{"for": 1.0}, {"for": 1.0, "held": ["A"]}]})
    source = script_source(F710_X, script, loop=True)
    source.at(0.0)
    (_, buttons), until = source.at(7.5)
    assert (buttons[0], until) == (1, 8.0)
    assert source.at(8.0)[0][1][0] == 0


@pytest.mark.parametrize(
    ("document", "line"),
    [
        (None, "it has no list `moves`"),
        ({"moves": []}, "the list `moves` is empty"),
        ({"moves": [{"for": 1}], "speed": 2}, "`speed` is unknown"),
        ({"mode": "Z", "moves": [{"for": 1}]}, "mode is 'Z'; allowed are D and X"),
        ({"moves": [7]}, "move 1: 7 is not a map"),
        ({"moves": [{"for": 1}, {}]}, "move 2: `for` is None"),
        ({"moves": [{"for": math.nan}]}, "move 1: `for` is nan"),
        ({"moves": [{"for": 1, "stick": [0, 0]}]}, "move 1: `stick` is unknown"),
        ({"moves": [{"for": 1, "left_stick": [0, 2]}]}, "move 1: left_stick is [0, 2]; allowed"),
        ({"moves": [{"for": 1, "left_stick": [0]}]}, "move 1: left_stick is [0]; allowed"),
        ({"moves": [{"for": 1, "left_stick": 1}]}, "move 1: left_stick is 1; allowed is a list"),
        ({"moves": [{"for": 1, "held": ["LOGITECH"]}]}, "move 1: 'LOGITECH' is no button in D"),
        ({"moves": [{"for": 1, "held": [[]]}]}, "move 1: held is [[]]"),
        ({"moves": [{"for": 1, "plugged": 0}]}, "move 1: plugged is 0; allowed is a bool"),
    ],
)
def test_a_mistake_in_a_script_is_named(document, line):
    with pytest.raises(ValueError) as error:
        load_script(document)
    assert str(error.value).startswith(line)


# --------------------------------------------------------------------------------- the recording


def test_a_recording_keeps_its_times():
    times_and_values = ((5.0, 0.0), (5.5, 1.0), (6.0, 0.0))
    recorded = [(t, ((0.0, value, 0, 0, 0, 0), (0,) * 12)) for t, value in times_and_values]
    source = recording_source(F710_D, recorded, loop=False)
    source.at(100.0)
    (axes, _), until = source.at(100.6)
    assert (axes[1], until) == (1.0, 101.0)
    assert source.at(101.6) is None


@pytest.mark.parametrize(
    ("recorded", "line"),
    [
        (
            [(0.0, ((0.0,) * 8, (0,) * 11))],
            "a message has 8 axes and 11 buttons; this gamepad has 6",
        ),
        ([(0.0, ((math.nan,) * 6, (0,) * 12))], "a message has axes beyond"),
        ([(0.0, ((0.0,) * 5 + (1.01,), (0,) * 12))], "a message has axes beyond"),
        ([(0.0, ((-1.01,) + (0.0,) * 5, (0,) * 12))], "a message has axes beyond"),
        ([(0.0, ((0.0,) * 6, (0,) * 12))], "there are fewer than two messages"),
        ([(1.0, ((0.0,) * 6, (0,) * 12))] * 2, "all messages have one time"),
    ],
)
def test_a_recording_that_does_not_fit_is_refused(recorded, line):
    with pytest.raises(ValueError) as error:
        recording_source(F710_D, recorded, loop=False)
    assert str(error.value).startswith(line)


def test_the_scripts_that_come_along_can_be_read():
    folder = (
        Path(__file__).resolve().parents[3] / "common" / "gamepad" / "config" / "virtual_joystick"
    )
    scripts = sorted(folder.glob("*.yaml"))
    assert scripts
    for path in scripts:
        assert load_script(yaml.safe_load(path.read_text(encoding="utf-8"))).moves


def test_released_keys_are_up_whatever_was_held():
    keyboard = Keyboard()
    keyboard.press(" w", 1.0)
    assert keyboard.at(1.1)[0].held == {"LB"}
    keyboard.release()
    assert keyboard.at(1.1)[0] == Controls()


# ---------------------------------------------------------------------------------------- the FIFO


def test_a_fifo_is_served_by_one_gamepad_only(tmp_path):
    path = str(tmp_path / "fifo")
    rest = positions(F710_D, Controls())
    with StreamPad(F710_D, path) as first:
        reader = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        first.show(rest)
        assert first.connected
        with StreamPad(F710_D, path) as second, pytest.raises(PadError, match="another"):
            second.show(rest)
        assert os.path.exists(path)
        os.close(reader)
    assert not os.path.exists(path)
