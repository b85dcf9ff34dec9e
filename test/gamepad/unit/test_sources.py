"""What moves a virtual gamepad over time: hands, keys, a script of moves, or a recording."""

import math

import pytest

from gamepad.gamepads import F710_D, F710_X
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.keyboard import FIRST_HOLD_S, Keyboard
from gamepad.virtual.moves import MoveScript, load_script
from gamepad.virtual.sources import KeySource, recording_source, script_source

REST, PRESSED = positions(F710_D, Controls()), positions(F710_D, Controls(held={"A"}))


@pytest.mark.parametrize("loop", [False, True])
def test_a_script_is_followed_in_time_and_begins_again_if_it_loops(loop):
    moves = [{"for": 1.0}, {"for": 2.0, "held": ["A"]}, {"for": 0.5, "plugged": False}]
    source = script_source(F710_D, load_script({"moves": moves}), loop=loop)
    for begin in (100.0, 103.5, 275.0) if loop else (100.0,):
        assert source.at(begin) == source.at(begin + 0.75) == (REST, begin + 1.0)
        assert source.at(begin + 1.0) == source.at(begin + 2.75) == (PRESSED, begin + 3.0)
        assert source.at(begin + 3.0) == (None, begin + 3.5)
    assert loop or source.at(103.5) is None


def recording(*times):
    """Return messages at these times; axis 1 counts them, in quarters."""
    return [(t, ((0.0, n / 4, 0.0, 0.0, 0.0, 0.0), (0,) * 12)) for n, t in enumerate(times)]


# Rows: the times of the messages; then when axis 1 changes, and the end, both from the start. The
# last message is held for the average time. A message older than the one before takes no time.
@pytest.mark.parametrize(
    ("times", "changes"),
    [
        ((1.0, 1.25), [(0.0, 0.0), (0.25, 0.25), (0.5, None)]),
        ((1.0, 2.0, 1.5, 2.5), [(0.0, 0.0), (1.0, 0.5), (2.0, 0.75), (2.0 + 2.0 / 3, None)]),
    ],
)  # fmt: skip
def test_a_recording_keeps_its_times(times, changes):
    source, again = (recording_source(F710_D, recording(*times), loop) for loop in (False, True))
    for (since, value), (until, _) in zip(changes, changes[1:]):
        for now in (20.0 + since, 20.0 + until - 0.01):
            (axes, _), end = source.at(now)
            assert (axes[1], end) == (value, pytest.approx(20.0 + until))
            assert again.at(now) == ((axes, (0,) * 12), end)
    end = 20.0 + changes[-1][0] + 0.001
    assert source.at(end) is None
    assert again.at(end)[0][0][1] == 0.0


def messages(*axes, buttons=12, times=(0.0,)):
    return [(time, (axes, (0,) * buttons)) for time in times]


@pytest.mark.parametrize(
    ("recorded", "line"),
    [
        (messages(*(0.0,) * 8, buttons=11),
         "a message has 8 axes and 11 buttons; this gamepad has 6 and 12"),
        (messages(*(0.0,) * 5, 1.01), "a message has axes beyond"),
        # The kernel's range is not quite symmetric, so some drivers go slightly beyond 1.
        (messages(-1.001, *(1.001,) * 5), "there are fewer than two messages"),
        (messages(*(0.0,) * 6, times=(1.0, 1.0)), "all messages have the same time"),
    ],
)  # fmt: skip
def test_a_recording_that_does_not_fit_is_refused(recorded, line):
    with pytest.raises(ValueError) as error:
        recording_source(F710_D, recorded, loop=False)
    assert str(error.value).startswith(line)


def test_keys_move_the_gamepad_until_they_quit():
    source = KeySource(F710_D, Keyboard())
    assert source.at(0.0) == (REST, math.inf)
    source.keyboard.press(" w", 1.0)
    pushed = Controls(left_stick=(0.0, 1.0), held=frozenset(["LB"]))
    assert source.at(1.0) == (positions(F710_D, pushed), 1.0 + FIRST_HOLD_S)
    assert source.controls == pushed
    source.keyboard.press("u", 1.1)
    assert source.at(1.1) == (None, 1.0 + FIRST_HOLD_S)
    source.keyboard.press("q", 1.2)
    assert source.at(1.2) is None


PUSHED = {"left_stick": (0.6, -0.25), "dpad": (0.0, 1.0)}
RIGHT = {"right_stick": (0.25, -0.75), "triggers": (0.25, 0.75)}


@pytest.mark.parametrize(
    ("pad", "moved", "axes", "held"),
    [
        (F710_D, {**PUSHED, "mode_led": True}, (0, 1, 0, 0, 1, 0), []),
        (F710_D, RIGHT, (0, 0, 0.25, -0.75, 0, 0), ["RT"]),
        (F710_D, {"triggers": (0.5, 0.5), "dpad": (-0.5, 0.5)}, (0,) * 6, []),
        (F710_X, {"triggers": (1.0, 0.0), "held": {"A"}}, (0, 0, -1, 0, 0, 1, 0, 0), ["A"]),
        (F710_X, {"dpad": (-0.75, 0.75)}, (0, 0, 1, 0, 0, 1, -1, 1), []),
        (F710_X, {}, (0, 0, 1, 0, 0, 1, 0, 0), []),
    ],
)
def test_a_position_of_hands_gives_axes_and_buttons(pad, moved, axes, held):
    shown, buttons = positions(pad, Controls(**moved))
    assert shown == axes
    assert [name for name, down in zip(pad.buttons, buttons) if down] == held


def test_a_move_may_last_a_day_and_has_every_position():
    given = {
        "left_stick": (-1, 1), "right_stick": (1, -1), "dpad": (-1, 1), "triggers": (0, 1),
        "held": ["A"], "mode_led": True, "plugged": True,
    }  # fmt: skip
    lists = {part: list(value) for part, value in given.items() if isinstance(value, tuple)}
    script = load_script({"mode": "X", "moves": [{"for": 86400, **given, **lists}]})
    controls = Controls(**{**given, "held": frozenset(["A"])})
    assert script == MoveScript(((86400.0, controls),), "X")
    assert load_script({"moves": [{"for": 0.5}]}) == MoveScript(((0.5, Controls()),), "D")


MOVES = [
    *[({"for": value}, f"for: {value!r}: must be seconds") for value in (
        math.nan, 0, 86400.5, True)],
    *[({part: value}, f"{part}: {value!r}: must be two numbers from -1 to 1") for value in (
        1, [0, 0, 0], [0, -1.5], [math.nan, 0]) for part in ("left_stick", "dpad")],
    ({"triggers": [-0.5, 0]}, "triggers: [-0.5, 0]: must be two numbers from 0 to 1"),
    ({"held": [[]]}, "held: [[]]: must be a list of"),
    ({"held": ["LOGITECH", "A"]}, "'LOGITECH' is no button in D mode: X, A, B, Y, LB, RB, LT"),
    ({"plugged": 0}, "plugged: 0: must be true or false"),
    ({"stick": [0, 0]}, "stick: [0, 0]: no such parameter"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("document", "line"),
    [
        (None, "it has no list of moves, such as "),
        ({"moves": []}, "moves: []: must be a list of moves"),
        ({"moves": [{"for": 1}], "speed": 2}, "speed: 2: no such parameter; allowed: mode, moves"),
        ({"moves": [7]}, "move 1: 7 is not a map"),
        *[({"moves": [{"for": 1}, {"for": 1, **move}]}, f"move 2: {line}") for move, line in MOVES],
    ],
)
def test_a_mistake_in_a_script_is_named(document, line):
    with pytest.raises(ValueError) as error:
        load_script(document)
    assert str(error.value).startswith(line)
