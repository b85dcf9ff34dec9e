"""Hints about a gamepad in another mode."""

import pytest

from joy_to_twist.gamepad_hints import GamepadHints
from joy_to_twist.parameters import load


def six(**values):
    return tuple(values.get(f"a{i}", 0.0) for i in range(6))


MODE, SWITCH, EIGHT = "press MODE", "8 axes and not 6: check the D/X switch", (0.0,) * 8


@pytest.mark.parametrize(("about", "messages", "given", "hint"), [
    ("another number of axes, once", [EIGHT] * 3, {"gamepad_axes": 6}, SWITCH),
    ("a stick on axes 4 and 5", [six(), six(a5=0.4)], {}, MODE),
    ("worn sticks", [six(a4=0.1, a5=-0.1), six(a1=0.1)], {}, None),
    ("whole steps, as a D-pad gives", [six(), six(a4=1.0), six(a5=-1.0), six()], {}, MODE),
    ("the stick has moved before", [six(a1=0.5), six(a5=0.4)], {}, None),
    ("axes 4 and 5 in use", [six(a5=0.4)], {"axis_linear": 5, "axis_angular": 4}, None),
    ("no such LED on other pads", [(0.0,) * 5 + (0.5, 0.0, 0.0)], {}, None),
])  # fmt: skip
def test_a_gamepad_in_another_mode_is_reported_once(about, messages, given, hint):
    looker = GamepadHints(load(given))
    found = [line for line in (looker.hint(axes, ()) for axes in messages) if line]
    assert len(found) == (hint is not None), about
    assert hint is None or hint in found[0]


def test_a_missing_turbo_button_is_reported_once():
    looker = GamepadHints(load({"enable_button": 0, "enable_turbo_button": 5}))
    shown = [looker.hint(six(), (1,) * count) for count in (6, 4, 4, 6, 6)]
    assert [bool(line) for line in shown] == [False, True, False, False, False]
    assert "no button 5 (~enable_turbo_button): it has 4 buttons" in shown[1]
