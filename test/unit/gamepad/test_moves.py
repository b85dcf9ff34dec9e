"""A script of moves: what it may say, and how a mistake is named."""

import math
from pathlib import Path

import pytest
import yaml

from gamepad.virtual.controls import Controls
from gamepad.virtual.moves import Script, load_script


def test_a_move_may_last_a_day_and_has_every_position():
    move = {
        "for": 86400, "left_stick": [-1, 1], "right_stick": [1, -1], "dpad": [-1, 1],
        "triggers": [0, 1], "held": ["A"], "mode_led": True, "plugged": True,
    }  # fmt: skip
    ((duration, controls),) = load_script({"mode": "X", "moves": [move]}).moves
    assert duration == 86400.0
    assert controls == Controls(
        (-1, 1), (1, -1), (-1, 1), (0, 1), frozenset(["A"]), mode_led=True, plugged=True
    )


@pytest.mark.parametrize(
    ("document", "line"),
    [
        (None, "it has no list `moves`"),
        ({}, "it has no list `moves`"),
        ({"moves": 5}, "it has no list `moves`"),
        ({"moves": []}, "the list `moves` is empty"),
        ({"moves": [{"for": 1}], "speed": 2}, "`speed` is unknown"),
        ({"moves": [], "b": 1, "c": 1, "a": 1}, "`a` is unknown; allowed are `mode` and `moves`"),
        ({"mode": "Z", "moves": [{"for": 1}]}, "mode is 'Z'; allowed are D and X"),
        ({"mode": ["D"], "moves": [{"for": 1}]}, "mode is ['D']; allowed are D and X"),
        ({"mode": 5, "moves": [{"for": 1}]}, "mode is 5; allowed are D and X"),
        ({"moves": [7]}, "move 1: 7 is not a map"),
        ({"moves": [{"for": 1}, {}]}, "move 2: `for` is None"),
        ({"moves": [{"for": math.nan}]}, "move 1: `for` is nan"),
        ({"moves": [{"for": 0}]}, "move 1: `for` is 0"),
        ({"moves": [{"for": -1}]}, "move 1: `for` is -1"),
        (
            {"moves": [{"for": 86400.5}]},
            "move 1: `for` is 86400.5; allowed are seconds above 0, up to 86400",
        ),
        ({"moves": [{"for": "1"}]}, "move 1: `for` is '1'"),
        ({"moves": [{"for": True}]}, "move 1: `for` is True"),
        ({"moves": [{"for": 1, "dpad": [0, True]}]}, "move 1: dpad is [0, True]; allowed"),
        ({"moves": [{"for": 1, "dpad": [0, -1.5]}]}, "move 1: dpad is [0, -1.5]; allowed"),
        ({"moves": [{"for": 1, "right_stick": [1, 1, 1]}]}, "move 1: right_stick is [1, 1, 1]"),
        ({"moves": [{"for": 1, "triggers": [-0.5, 0]}]}, "move 1: triggers is [-0.5, 0]; allowed"),
        ({"moves": [{"for": 1, "stick": [0, 0]}]}, "move 1: `stick` is unknown"),
        (
            {"moves": [{"for": 1, "pad": 1, "stick": 1, "button": 1}]},
            "move 1: `button` is unknown; allowed are for, left_stick, right_stick, dpad, triggers,"
            " held, mode_led, plugged",
        ),
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


def test_the_scripts_that_come_along_can_be_read():
    folder = (
        Path(__file__).resolve().parents[3] / "common" / "gamepad" / "config" / "virtual_joystick"
    )
    scripts = sorted(folder.glob("*.yaml"))
    assert scripts
    for path in scripts:
        assert load_script(yaml.safe_load(path.read_text(encoding="utf-8"))).moves


def test_a_script_never_changes_and_can_be_compared():
    script = load_script({"moves": [{"for": 0.5}]})
    assert script == Script("D", ((0.5, Controls()),))
    with pytest.raises(AttributeError):
        script.mode = "X"
