"""Positions of all controls of a Logitech F710, and the axes and buttons that they give."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

from gamepad.gamepads import Gamepad
from node_kit.parameters.declaration import Allowed, is_number, parameter, switch

# From this deflection on, a stick moves the D-pad's axes, which have only -1, 0 and 1.
DIGITAL_THRESHOLD = 0.5


def _two_numbers(low: float) -> Allowed:
    def fits(value: object) -> bool:
        pair = value if isinstance(value, list) else []
        return len(pair) == 2 and all(is_number(part) and low <= part <= 1 for part in pair)

    return Allowed(f"two numbers from {low} to 1", fits, keep=tuple)


def _are_names(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(name, str) for name in value)


@dataclass(frozen=True)
class Controls:
    """One position of all controls of the gamepad.

    Sticks and D-pad: (x, y) from -1 to 1, left and up positive as on /joy. triggers: (LT, RT) from
    0 (released) to 1. held: names of buttons, see gamepads. mode_led: lit by pressing MODE; the
    left stick and the D-pad are then swapped. plugged: whether the gamepad is connected.
    """

    left_stick: tuple[float, float] = parameter((0.0, 0.0), _two_numbers(-1))
    right_stick: tuple[float, float] = parameter((0.0, 0.0), _two_numbers(-1))
    dpad: tuple[float, float] = parameter((0.0, 0.0), _two_numbers(-1))
    triggers: tuple[float, float] = parameter((0.0, 0.0), _two_numbers(0))
    held: frozenset[str] = parameter(
        frozenset(), Allowed("a list of names of buttons", _are_names, keep=frozenset)
    )
    mode_led: bool = parameter(False, switch)
    plugged: bool = parameter(True, switch)


Position = Tuple[Tuple[float, ...], Tuple[int, ...]]  # axes and buttons


def positions(gamepad: Gamepad, controls: Controls) -> Position:
    """Return (axes, buttons) as on /joy. gamepad: one of gamepads.F710."""
    stick, dpad = controls.left_stick, controls.dpad
    if controls.mode_led:
        stick, dpad = dpad, stick
    x, y = [float((v > DIGITAL_THRESHOLD) - (v < -DIGITAL_THRESHOLD)) for v in dpad]
    held = set(controls.held)
    if gamepad.triggers:
        left, right = [1.0 - 2.0 * pressed for pressed in controls.triggers]
        axes: tuple[float, ...] = (*stick, left, *controls.right_stick, right, x, y)
    else:  # in D mode, the triggers are buttons
        axes = (*stick, *controls.right_stick, x, y)
        pulled = [v > DIGITAL_THRESHOLD for v in controls.triggers]
        held.update(name for name, down in zip(("LT", "RT"), pulled) if down)
    return axes, tuple([int(name in held) for name in gamepad.buttons])
