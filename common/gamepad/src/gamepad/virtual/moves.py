"""A script of timed moves of a gamepad, from YAML (pure).

    mode: D                 # the switch of the F710: D or X
    moves:
      - {for: 1.0}                                              # nobody touches it, for 1 s
      - {for: 2.0, held: [LB], left_stick: [0.0, 0.5]}          # half speed ahead
      - {for: 1.0, plugged: false}

Besides `for` [s], a move has the names of controls.Controls; what it leaves out is released.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from gamepad.gamepads import F710
from gamepad.virtual.controls import Controls, check_controls
from node_kit.parameters import is_number

LONGEST_S = 86400


@dataclass(frozen=True)
class Script:
    """mode: of the F710. moves: pairs of a duration [s] and Controls."""

    mode: str
    moves: tuple[tuple[float, Controls], ...]


def load_script(document: Any) -> Script:
    """Check what YAML gave. Raises ValueError, one line that names the move and what is allowed."""
    if not isinstance(document, dict) or not isinstance(document.get("moves"), list):
        raise ValueError("it has no list `moves`")
    unknown = sorted(set(map(str, document)) - {"mode", "moves"})
    if unknown:
        raise ValueError(f"`{unknown[0]}` is unknown; allowed are `mode` and `moves`")
    mode = document.get("mode", "D")
    if not isinstance(mode, str) or mode not in F710:
        raise ValueError(f"mode is {mode!r}; allowed are {' and '.join(F710)}")
    moves = []
    for number, move in enumerate(document["moves"], 1):
        try:
            moves.append(_load_move(move, mode))
        except ValueError as error:
            raise ValueError(f"move {number}: {error}") from None
    if not moves:
        raise ValueError("the list `moves` is empty")
    return Script(mode, tuple(moves))


def _load_move(move: Any, mode: str) -> tuple[float, Controls]:
    names: dict[str, Any] = {f.name: f.default for f in fields(Controls)}
    if not isinstance(move, dict):
        raise ValueError(f"{move!r} is not a map such as {{for: 1.0, held: [LB]}}")
    unknown = sorted(set(map(str, move)) - set(names) - {"for"})
    if unknown:
        raise ValueError(f"`{unknown[0]}` is unknown; allowed are for, {', '.join(names)}")
    duration: Any = move.get("for")
    if not is_number(duration) or not 0 < duration <= LONGEST_S:
        raise ValueError(f"`for` is {duration!r}; allowed are seconds above 0, up to {LONGEST_S}")
    given: dict[str, Any] = {}
    for name in set(move) - {"for"}:
        value, default = move[name], names[name]
        wanted = bool if isinstance(default, bool) else list
        if not isinstance(value, wanted):
            raise ValueError(f"{name} is {value!r}; allowed is a {wanted.__name__}")
        try:
            given[name] = value if wanted is bool else type(default)(value)
        except TypeError:  # held: a list of lists
            raise ValueError(f"{name} is {value!r}; allowed are names of buttons") from None
    controls = Controls(**given)
    check_controls(controls, mode)
    return float(duration), controls
