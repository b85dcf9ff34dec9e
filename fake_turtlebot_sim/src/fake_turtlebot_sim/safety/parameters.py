"""The private parameters of the safety controller and their checks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

from node_kit.parameters.declaration import checked, number, parameter


@dataclass(frozen=True)
class SafetyParameters:
    """The parameters with their defaults."""

    time_to_extend_bump_cliff_events: float = parameter(
        0.0,
        number(0.0, 10.0, "s"),
        "least time for which the robot backs away, from the last press",
    )


def parse_parameters(given: Mapping[str, Any]) -> SafetyParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    return SafetyParameters(**checked(SafetyParameters, given))
