"""The page's F710 gives the same axes and buttons as gamepad.virtual.controls."""

import itertools

import pytest

from gamepad.gamepads import F710
from gamepad.virtual.controls import Controls, positions
from tutorial_testing.claims import claim

NAMES = {mode: list(pad.buttons) for mode, pad in F710.items()}
CASES = (
    Controls(),
    Controls(left_stick=(0.5, -1.0), held=frozenset({"LB", "A"})),
    Controls(right_stick=(-0.25, 1.0), triggers=(1.0, 0.0), held=frozenset({"RB", "START"})),
    Controls(dpad=(1.0, -1.0), triggers=(0.25, 1.0), held=frozenset({"LEFT"})),
)


def call(page, name, *values):
    script = """const [name, values, done] = arguments;
        import('/page/f710.js').then((module) => done(module[name](...values)));"""
    return page.driver.execute_async_script(script, name, values)


@claim("The page's F710 is that of the package gamepad, at D and X, by glass and by any gamepad")
def test_hands_on_glass_and_on_a_gamepad_of_the_kernel_give_the_same_message(page):
    for mode, controls in itertools.product(F710, CASES):
        axes, buttons = positions(F710[mode], controls)
        glass = {
            "left": controls.left_stick, "right": controls.right_stick, "dpad": controls.dpad,
            "triggers": controls.triggers, "held": sorted(controls.held),
        }  # fmt: skip
        # Without the standard mapping, right and down are positive.
        held = [{"pressed": bool(button), "value": float(button)} for button in buttons]
        raw = {"mapping": "", "axes": [-v for v in axes], "buttons": held}
        for hands in (glass, call(page, "handsOfGamepad", raw, NAMES)):
            shown = call(page, "positions", mode, NAMES[mode], hands)
            assert shown["axes"] == pytest.approx(axes, abs=0.05)  # the dead zone is rescaled
            assert tuple(shown["buttons"]) == buttons
