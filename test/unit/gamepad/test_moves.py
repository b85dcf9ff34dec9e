"""A script of moves: what it may say, and how a mistake is named."""

import math
from pathlib import Path

import pytest
import yaml

from gamepad.virtual.controls import Controls
from gamepad.virtual.moves import Script, load_script

SCRIPTS = Path(__file__).parents[3] / "common" / "gamepad" / "config" / "virtual_joystick"


def test_a_move_may_last_a_day_and_has_every_position():
    given = {
        "left_stick": (-1, 1), "right_stick": (1, -1), "dpad": (-1, 1), "triggers": (0, 1),
        "held": ["A"], "mode_led": True, "plugged": True,
    }  # fmt: skip
    lists = {part: list(value) for part, value in given.items() if isinstance(value, tuple)}
    script = load_script({"mode": "X", "moves": [{"for": 86400, **given, **lists}]})
    controls = Controls(**{**given, "held": frozenset(["A"])})
    assert script == Script(((86400.0, controls),), "X")
    assert load_script({"moves": [{"for": 0.5}]}) == Script(((0.5, Controls()),), "D")


@pytest.mark.parametrize(
    ("document", "line"),
    [
        (None, "it has no list of moves, such as "),
        ({}, "moves: missing; such as moves: [{for"),
        ({"moves": []}, "moves: []: must be a list of moves"),
        ({"moves": [{"for": 1}], "speed": 2}, "speed: 2: no such parameter; allowed: mode, moves"),
        ({"mode": ["D"], "moves": [{"for": 1}]}, "mode: ['D']: must be D or X"),
        ({"moves": [7]}, "move 1: 7 is not a map"),
    ],
)
def test_a_mistake_in_a_script_is_named(document, line):
    with pytest.raises(ValueError) as error:
        load_script(document)
    assert str(error.value).startswith(line)


SECONDS, STICK, BUTTONS = "must be seconds", "must be two numbers from -1 to 1", "must be a list of"


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        *[({"for": value}, f"for: {value!r}: {SECONDS}") for value in (
            math.nan, 0, 86400.5, "1", True)],
        *[({part: value}, f"{part}: {value!r}: {STICK}") for value in (
            1, [0, 0, 0], [0, -1.5], [math.nan, 0], ["x", 0]) for part in ("left_stick", "dpad")],
        ({"triggers": [-0.5, 0]}, "triggers: [-0.5, 0]: must be two numbers from 0 to 1"),
        ({"held": "LB"}, f"held: 'LB': {BUTTONS}"),
        ({"held": [[]]}, f"held: [[]]: {BUTTONS}"),
        ({"held": ["LOGITECH", "A"]}, "'LOGITECH' is no button in D mode: X, A, B, Y, LB, RB, LT"),
        ({"plugged": 0}, "plugged: 0: must be true or false"),
        ({"stick": [0, 0]}, "stick: [0, 0]: no such parameter"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_move_is_named(wrong, line):
    with pytest.raises(ValueError) as error:
        load_script({"moves": [{"for": 1}, {"for": 1, **wrong}]})
    assert str(error.value).startswith(f"move 2: {line}")


@pytest.mark.parametrize("path", sorted(SCRIPTS.glob("*.yaml")), ids=lambda path: path.stem)
def test_the_scripts_that_come_along_can_be_read(path):
    assert load_script(yaml.safe_load(path.read_text(encoding="utf-8"))).moves
