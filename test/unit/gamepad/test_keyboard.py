"""Keys and times in, the position of a gamepad out."""

import math

import pytest

from gamepad.virtual.controls import Controls
from gamepad.virtual.keyboard import FIRST_HOLD_S, REPEAT_HOLD_S, Keyboard


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
    keyboard.press("xyz\x1b[9~q", 0.0)
    assert keyboard.quit


def test_released_keys_are_up_whatever_was_held():
    keyboard = Keyboard()
    keyboard.press(" w", 1.0)
    assert keyboard.at(1.1)[0].held == {"LB"}
    keyboard.release()
    assert keyboard.at(1.1)[0] == Controls()


def test_all_other_keys_do_nothing():
    mean_something = set("wasd tmuq0123456789\x03\x04")
    others = [chr(n) for n in range(0x250) if chr(n).lower() not in mean_something]
    keyboard = Keyboard()
    for key in [*others, "\ufffd"]:
        keyboard.press(key, 1.0)
        assert keyboard.at(1.0) == (Controls(), math.inf), key
        assert not keyboard.quit, key


@pytest.mark.parametrize(
    "key",
    [
        *("\x1bOP", "\x1bOQ", "\x1bOS", "\x1b[[A", "\x1b[[D", "\x1b[15~"),  # F1 to F5
        *("\x1b[1;5A", "\x1b[1;2D", "\x1bOa", "\x1b[a"),  # arrows with Ctrl or Shift
        *("\x1b[3~", "\x1b[Z"),  # Delete, Shift and Tab
    ],
)
def test_a_function_key_does_nothing_whatever_letters_it_sends(key):
    """F4 drove backward, Ctrl with the arrow up to the left, and Delete changed the speed."""
    keyboard = Keyboard()
    keyboard.press(key, 1.0)
    assert keyboard.at(1.0) == (Controls(), math.inf)
    assert not keyboard.quit
    keyboard.press(f"w{key}a", 1.0)
    assert at(keyboard, 1.0) == ((1, 1), [])


@pytest.mark.parametrize(
    "key", ["\x1b[B", "\x1bOB", "\x1b[[D", "\x1b[15~", "\x1b[1;5A", "\x1b[0 q"]
)
def test_a_key_cut_in_two_is_read_as_in_one(key):
    """Over a slow line an arrow's last letter came alone: down was A, to the left."""
    whole = Keyboard()
    whole.press(f"t{key}5", 1.0)
    for cut in range(1, len(key)):
        keyboard = Keyboard()
        keyboard.press(f"t{key[:cut]}", 1.0)
        keyboard.press(f"{key[cut:]}5", 1.0)
        assert keyboard.at(1.0) == whole.at(1.0), cut
        assert not keyboard.quit


@pytest.mark.parametrize("begun", ["\x1b", "\x1b["])
def test_a_sequence_that_never_ends_holds_no_key_back(begun):
    keyboard = Keyboard()
    keyboard.press(begun, 1.0)
    keyboard.press("\x03", 2.0)
    assert keyboard.quit


def test_a_superscript_is_no_digit():
    """A key of French keyboards; it ended the program."""
    keyboard = Keyboard()
    keyboard.press("5w\u00b2", 1.0)
    assert at(keyboard, 1.0) == ((0, 0.5), [])


def test_a_capital_that_becomes_two_letters_takes_no_other_key_along():
    keyboard = Keyboard()
    keyboard.press("\u0130w", 1.0)  # a key of Turkish keyboards
    assert at(keyboard, 1.0) == ((0, 1), [])


def test_a_direction_by_another_key_is_the_same_one_and_not_a_second():
    keyboard = Keyboard()
    keyboard.press("w\x1b[A", 1.0)
    assert at(keyboard, 1.0) == ((0, 1), [])
    keyboard.press("aw", 1.1)
    assert at(keyboard, 1.1) == ((1, 1), [])


def test_a_key_held_once_is_held_longer_than_one_that_repeats():
    keyboard = Keyboard()
    keyboard.press("a", 1.0)
    assert keyboard.at(1.0)[1] == 1.0 + FIRST_HOLD_S
    keyboard.press("a", 1.5)
    assert keyboard.at(1.5)[1] == 1.5 + REPEAT_HOLD_S


def test_at_first_the_stick_goes_all_the_way_and_nothing_is_held():
    keyboard = Keyboard()
    assert keyboard.at(0.0) == (Controls(), math.inf)
    keyboard.press("d", 0.5)
    assert at(keyboard, 0.5) == ((-1.0, 0), [])


def test_m_swaps_and_u_unplugs_and_neither_does_the_others_work():
    for key, expected in (("m", Controls(mode_led=True)), ("u", Controls(plugged=False))):
        keyboard = Keyboard()
        keyboard.press(key, 0.0)
        assert keyboard.at(0.0) == (expected, math.inf)
        assert not keyboard.quit
