"""Every preset in config/ loads and drives as documented."""

import pytest
import yaml

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from node_kit.rules.arming import ZERO
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

CONFIG = REPOSITORY / "joy2twist" / "config"
PRESETS = {path.stem: yaml.safe_load(path.read_text()) for path in sorted(CONFIG.glob("*.yaml"))}
# Numbers of axes and of buttons; axes for forward and left; dead-man and turbo buttons.
# Source: reference of the F710; xpad.c, hid-sony.c and hid-playstation.c of Linux 6.1.
GAMEPADS = {
    "extreme_3d": (6, 12, 1, 2, 0, 1),
    "f710_d": (6, 12, 1, 0, 4, 5),
    "f710_x": (8, 11, 1, 0, 4, 5),
    "ps3": (6, 17, 1, 0, 4, 5),
    "ps4": (8, 13, 1, 0, 4, 5),
    "xbox": (8, 11, 1, 0, 4, 5),
}


@claim("Every parameter has ...", because="the presets")
@pytest.mark.parametrize("name", sorted({*GAMEPADS, *PRESETS}))
def test_preset(name):
    axis_count, button_count, forward, left, dead_man, turbo = GAMEPADS[name]
    warnings = []
    machine = Teleoperation(load(PRESETS[name]), warnings.append, wake=lambda: None)

    def joy(held, value=1.0):
        axes, buttons = [0.0] * axis_count, [0] * button_count
        axes[forward], axes[left] = value, value / 2
        for button in held:
            buttons[button] = 1
        return machine.joy(axes, buttons, now=0.0)

    assert joy([dead_man]) == pytest.approx((0.35, 0, 0, 0, 0, 0.6))
    assert joy([turbo]) == pytest.approx((0.7, 0, 0, 0, 0, 1.0))
    assert joy([]) == ZERO
    # A value beyond any stick drives no faster than the preset's maximum.
    assert joy([dead_man], -465.0) == pytest.approx((-0.7, 0, 0, 0, 0, -2.0))
    assert warnings == []  # the number of axes is as expected
    machine.joy([0.0] * (axis_count + 1), [0] * button_count, now=0.0)
    assert f"{axis_count + 1} axes and not {axis_count}" in warnings[0]


@claim("The three steps ...", because="45 lines")
def test_a_step_is_read_at_a_glance():
    for step in CONFIG.with_name("scripts").glob("steps/*.py"):
        assert step.read_text().count("\n") <= 45, step
