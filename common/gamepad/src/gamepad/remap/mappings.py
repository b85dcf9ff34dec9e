"""The parameter ~mappings of joy_remap: a formula for each axis and button that it publishes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

from gamepad.remap.formulas import Controls, Formula, formula
from node_kit.parameters.declaration import unknown

PARTS = ("axes", "buttons")
KNOWN = ("mappings", "queue_size")  # upstream has queue_size; it has no effect here


@dataclass(frozen=True)
class Mappings:
    """The formulas of the axes and buttons, in their order."""

    axes: list[Formula]
    buttons: list[Formula]

    def apply(self, controls: Controls) -> tuple[list[float], list[int]]:
        """Return (axes, buttons), buttons 0 or 1. Raises ValueError, one line."""
        try:
            axes = [float(compute(controls)) for compute in self.axes]
            return axes, [int(compute(controls) > 0) for compute in self.buttons]
        except IndexError:
            has = " and ".join(f"{len(controls[part])} {part}" for part in PARTS)
            raise ValueError(f"the formulas need more than its {has}") from None
        except (ArithmeticError, TypeError) as error:
            raise ValueError(str(error)) from None


def load(given: Mapping[str, Any]) -> Mappings:
    """Return the checked ~mappings. Raises ValueError, one line."""
    for name in given:
        if name not in KNOWN:
            raise ValueError(unknown(name, given[name], KNOWN))
    mappings = given.get("mappings", {})
    if not isinstance(mappings, dict):
        raise ValueError("~mappings: must have the lists axes and buttons")
    lists: dict[str, list[Formula]] = {}
    for part in PARTS:
        values = mappings.get(part, [])
        if not isinstance(values, list):
            raise ValueError(f"~mappings/{part}: must be a list of formulas")
        try:
            lists[part] = [formula(value) for value in values]
        except ValueError as error:
            raise ValueError(f"~mappings/{part}: {error}") from None
    return Mappings(**lists)
