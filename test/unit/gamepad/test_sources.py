"""What moves a virtual gamepad, in time: a script, or a recording."""

import math

import pytest

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.moves import load_script
from gamepad.virtual.sources import recording_source, script_source


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
