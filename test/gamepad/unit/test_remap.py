"""One gamepad that looks like another: formulas, and the mappings that come with joy_remap."""

from pathlib import Path

import pytest
import yaml

from gamepad.remap.formulas import formula
from gamepad.remap.mappings import load
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("joy_remap makes one ...", because="every formula and its mistakes")
CONFIG = REPOSITORY / "common/stand_ins/joy/config"
CONTROLS = {"axes": [0.5, -0.25, 1.0], "buttons": [0, 1]}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("axes[0]", 0.5),
        ("0", 0.0),
        (0.5, 0.5),  # YAML reads some as numbers
        ("-axes[1] * 2.0", 0.5),
        ("(axes[2] - 3) / 4", -0.5),
        ("max(axes[0], axes[1], 0.75) + min(axes[0], 0)", 0.75),
        ("abs(axes[1])", 0.25),
        ("buttons[0] ^ buttons[1]", 1),
    ],
)
def test_a_formula_is_computed(text, value):
    assert formula(text)(CONTROLS) == value


@pytest.mark.parametrize(
    "text",
    [
        "", "axes", "axes[-1]", "axes[0:1]", "axes[buttons[0]]", "other[0]", "axes[0] ** 2", "1 +",
        "max(1)", "abs(1, 2)", "abs(x=1)", "__import__('os')", "'text'", "True", "axes[0].real",
        "1" * 1001, "(" * 300 + ")" * 300,
    ],
)  # fmt: skip
def test_what_is_no_formula_is_refused(text):
    with pytest.raises(ValueError, match="must be made of numbers"):
        formula(text)


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"mappings": 1}, "~mappings: must have the lists"),
        ({"mappings": {"axes": "axes[0]"}}, "~mappings/axes: must be a list"),
        ({"mappings": {"buttons": ["x"]}}, "~mappings/buttons: 'x'"),
        ({"mapings": {}}, "~mapings"),
    ],
)
def test_a_mistake_in_the_mappings_is_one_line(given, part):
    with pytest.raises(ValueError, match=part) as error:
        load(given)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(("pad", "axes", "buttons"), [("ps3", 6, 17), ("ps4", 14, 13)])
def test_the_mappings_give_a_gamepad_the_order_of_ps3joy(pad, axes, buttons):
    mappings = load(yaml.safe_load((Path(CONFIG) / f"{pad}joy.yaml").read_text()))
    controls = {"axes": [0.0] * axes, "buttons": [0] * buttons}
    l1, trigger = 4, {"ps3": 2, "ps4": 3}[pad]
    controls["axes"][1], controls["axes"][trigger], controls["buttons"][l1] = 0.5, -1.0, 1
    made = [compute(controls) for compute in mappings.axes]
    pressed = [compute(controls) > 0 for compute in mappings.buttons]
    assert (len(made), len(pressed)) == (27, 17)
    assert (made[1], made[12], made[14]) == (0.5, -1.0, -1.0)  # left stick, L2, L1
    assert [number for number, is_pressed in enumerate(pressed) if is_pressed] == [10]  # L1
