"""A script of timed moves of a gamepad, from YAML.

    mode: D                 # the switch of the F710: D or X
    moves:
      - {for: 1.0}                                              # untouched for 1 s
      - {for: 2.0, held: [LB], left_stick: [0.0, 0.5]}          # half speed ahead
      - {for: 1.0, plugged: false}

Besides `for` [s], a move has the fields of controls.Controls; a control that it omits is released.
"""

from __future__ import annotations

from dataclasses import MISSING, dataclass
from typing import Any

from gamepad.gamepads import F710
from gamepad.virtual.controls import Controls
from node_kit.parameters.declaration import Allowed, checked, checked_value, is_number, parameter

EXAMPLE = "such as moves: [{for: 1.0, held: [LB]}]"
_DURATION = Allowed(
    "seconds above 0, up to 86400", lambda v: is_number(v) and 0 < v <= 86400, keep=float
)


@dataclass(frozen=True)
class MoveScript:
    """mode: of the F710. moves: pairs of a duration [s] and Controls."""

    moves: tuple[tuple[float, Controls], ...] = parameter(
        MISSING, Allowed("a list of moves", lambda value: isinstance(value, list) and value)
    )
    mode: str = parameter("D", Allowed("D or X", lambda value: value in list(F710)))


def load_script(document: Any) -> MoveScript:
    """Return the moves in parsed YAML. Raises ValueError, one line with the number of the move."""
    if not isinstance(document, dict):
        raise ValueError(f"it has no list of moves, {EXAMPLE}")
    values = checked(MoveScript, document, where="", example=EXAMPLE)
    moves = []
    for number, move in enumerate(values["moves"], 1):
        try:
            moves.append(_load_move(move, values["mode"]))
        except ValueError as error:
            raise ValueError(f"move {number}: {error}") from None
    return MoveScript(tuple(moves), values["mode"])


def _load_move(move: Any, mode: str) -> tuple[float, Controls]:
    if not isinstance(move, dict):
        raise ValueError(f"{move!r} is not a map such as {{for: 1.0, held: [LB]}}")
    duration = checked_value("for", move.get("for"), _DURATION)
    given = {name: value for name, value in move.items() if name != "for"}
    controls = Controls(**checked(Controls, given, where=""))
    buttons = F710[mode].buttons
    wrong = sorted(controls.held.difference(buttons))
    if wrong:
        raise ValueError(f"{wrong[0]!r} is no button in {mode} mode: {', '.join(buttons)}")
    return duration, controls
