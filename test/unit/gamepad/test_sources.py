"""What moves a virtual gamepad, in time: a script, or a recording."""

import math

import pytest

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.keyboard import FIRST_HOLD_S, Keyboard
from gamepad.virtual.moves import load_script
from gamepad.virtual.sources import KeySource, recording_source, script_source


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
            "a message has 8 axes and 11 buttons; this gamepad has 6 and 12",
        ),
        ([(0.0, ((0.0,) * 6, (0,) * 11))], "a message has 6 axes and 11 buttons"),
        ([(0.0, ((0.0,) * 6, (0,) * 13))], "a message has 6 axes and 13 buttons"),
        ([], "there are fewer than two messages"),
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


def test_a_looped_script_that_began_late_changes_on_time_in_every_round():
    moves = [{"for": 1.0}, {"for": 2.0, "held": ["A"]}, {"for": 0.5, "plugged": False}]
    source = script_source(F710_D, load_script({"moves": moves}), loop=True)
    rest, pressed = positions(F710_D, Controls()), positions(F710_D, Controls(held={"A"}))
    source.at(100.0)
    for begin in (100.0, 103.5, 107.0, 275.0):
        assert source.at(begin) == (rest, begin + 1.0)
        assert source.at(begin + 0.75) == (rest, begin + 1.0)
        assert source.at(begin + 1.0) == (pressed, begin + 3.0)
        assert source.at(begin + 2.75) == (pressed, begin + 3.0)
        assert source.at(begin + 3.0) == (None, begin + 3.5)


def recording(*times):
    """Messages at these times; axis 1 counts them, in quarters."""
    return [(t, ((0.0, n / 4, 0.0, 0.0, 0.0, 0.0), (0,) * 12)) for n, t in enumerate(times)]


def shown(source, now):
    (axes, _), until = source.at(now)
    return axes[1], until


def test_the_last_message_of_a_recording_is_held_for_the_average():
    source = recording_source(F710_D, recording(5.0, 5.5, 6.5, 6.75), loop=True)
    assert shown(source, 20.0) == (0.0, 20.5)
    assert shown(source, 20.5) == (0.25, 21.5)
    assert shown(source, 21.5) == (0.5, 21.75)
    last, until = shown(source, 21.75)
    assert (last, until) == (0.75, pytest.approx(21.75 + 1.75 / 3))
    assert shown(source, until + 0.001)[0] == 0.0


def test_two_messages_are_a_recording():
    source = recording_source(F710_D, recording(1.0, 1.25), loop=False)
    assert shown(source, 0.0) == (0.0, 0.25)
    assert shown(source, 0.25) == (0.25, 0.5)
    assert source.at(0.5) is None


def test_a_message_that_is_older_than_the_one_before_takes_no_time_and_gives_none_back():
    source = recording_source(F710_D, recording(1.0, 2.0, 1.5, 2.5), loop=False)
    assert shown(source, 0.0) == (0.0, 1.0)
    assert shown(source, 1.0) == (0.5, 2.0)
    assert shown(source, 2.0) == (0.75, pytest.approx(2.0 + 2.0 / 3))


def test_an_axis_a_little_beyond_its_end_is_taken():
    """The kernel's range is not quite even, so that some drivers go beyond 1."""
    for end in (1.001, -1.001):
        recorded = [(time, ((end,) * 6, (0,) * 12)) for time in (0.0, 1.0)]
        assert recording_source(F710_D, recorded, loop=False).at(0.0)[0] == ((end,) * 6, (0,) * 12)


def test_keys_move_the_gamepad_until_they_quit():
    keyboard = Keyboard()
    source = KeySource(F710_D, keyboard)
    assert source.controls == Controls()
    assert source.at(0.0) == (positions(F710_D, Controls()), math.inf)
    keyboard.press(" w", 1.0)
    pushed = Controls(left_stick=(0.0, 1.0), held=frozenset(["LB"]))
    assert source.at(1.0) == (positions(F710_D, pushed), 1.0 + FIRST_HOLD_S)
    assert source.controls == pushed
    keyboard.press("u", 1.1)
    assert source.at(1.1) == (None, 1.0 + FIRST_HOLD_S)
    keyboard.press("q", 1.2)
    assert source.at(1.2) is None
