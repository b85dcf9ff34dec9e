"""Keys and times in, the position of a gamepad out."""

import math

import pytest

from gamepad.virtual.controls import Controls
from gamepad.virtual.keyboard import FIRST_HOLD_S, REPEAT_HOLD_S, Keyboard

# Rows: the keys pressed together, the place of the left stick, and the buttons held.
PRESSED = [
    ("bcefghijklnopvxyz-+", (0, 0), []),  # all other keys do nothing
    *[(key, (0, 1), []) for key in ("w", "W", "\x1b[A", "\x1bOA")],
    *[(key, (0, -1), []) for key in ("s", "S", "\x1b[B", "\x1bOB")],
    *[(key, (1, 0), []) for key in ("a", "A", "\x1b[D", "\x1bOD")],
    *[(key, (-1, 0), []) for key in ("d", "D", "\x1b[C", "\x1bOC")],
    (" ", (0, 0), ["LB"]),
    ("t", (0, 0), ["RB"]),
    ("1w", (0, 0.1), []),
    ("5w0", (0, 1), []),
    ("5w\u00b2", (0, 0.5), []),  # a superscript, of French keyboards, is no digit
    ("\u0130w", (0, 1), []),  # Turkish keyboards: two letters in lower case
    ("5wa", (0.5, 0.5), []),  # directions add up
    ("wad\x1bOB", (-1, -1), []),  # the later one of two opposites counts
]


@pytest.mark.parametrize(("keys", "stick", "held"), PRESSED, ids=repr)
def test_what_each_key_does_to_the_gamepad(keys, stick, held):
    keyboard = Keyboard()
    keyboard.press(keys, 1.0)
    controls, until = keyboard.at(1.0)
    assert controls == Controls(left_stick=stick, held=frozenset(held))
    assert until == (1.0 + FIRST_HOLD_S if any(stick) or held else math.inf)
    assert not keyboard.quit


SWITCHES = ("mUm", Controls(plugged=False), False)
QUITS = [(key, Controls(), True) for key in ("Q", "\x03", "\x04", "xyz\x1b[9~q")]


@pytest.mark.parametrize(("keys", "controls", "quits"), [SWITCHES, *QUITS])
def test_mode_and_plug_are_switched_and_some_keys_quit(keys, controls, quits):
    keyboard = Keyboard()
    keyboard.press(keys, 0.0)
    assert keyboard.at(0.0) == (controls, math.inf)
    assert keyboard.quit is quits


def test_a_key_that_is_not_repeated_is_released_or_all_are_at_once():
    assert 0.66 < FIRST_HOLD_S < 1.0  # the slowest terminal waits that long
    keyboard = Keyboard()
    keyboard.press("w", 1.0)
    assert keyboard.at(1.0 + FIRST_HOLD_S - 0.01)[0] == Controls(left_stick=(0, 1))
    assert keyboard.at(1.0 + FIRST_HOLD_S) == (Controls(), math.inf)
    keyboard.press(" w", 2.0)
    keyboard.release()
    assert keyboard.at(2.1)[0] == Controls()


def test_the_dead_man_stays_held_while_a_later_key_repeats_and_all_are_released_together():
    assert 1 / 11 < REPEAT_HOLD_S < 0.5  # the slowest repetition; joy2twist's ~joy_timeout
    keyboard = Keyboard()
    keyboard.press(" ", 0.0)
    for repetition in range(100):
        keyboard.press("\x1b[A", 0.5 + repetition * 0.04)
    held = Controls(left_stick=(0, 1), held=frozenset(["LB"]))
    assert keyboard.at(4.5) == (held, 4.46 + REPEAT_HOLD_S)
    assert keyboard.at(4.46 + REPEAT_HOLD_S + 0.001)[0] == Controls()


# F4, F1 and F5; arrows with Ctrl or Shift; Delete.
@pytest.mark.parametrize("key", ["\x1bOS", "\x1b[[A", "\x1b[15~", "\x1b[1;5A", "\x1bOa", "\x1b[3~"])
def test_a_function_key_does_nothing_whatever_letters_it_sends_and_wherever_it_is_cut(key):
    """F4 once drove backward, and over a slow line an arrow's last letter came alone."""
    for cut in range(1, len(key) + 1):
        keyboard = Keyboard()
        keyboard.press(f"w{key[:cut]}", 1.0)
        keyboard.press(f"{key[cut:]}a", 1.0)
        assert keyboard.at(1.0)[0] == Controls(left_stick=(1, 1)), cut
        assert not keyboard.quit
        keyboard.press(key[:1], 1.0)  # an unfinished sequence delays no key
        keyboard.press("\x03", 2.0)
        assert keyboard.quit
