"""The private parameters of cmd_vel_mux and their checks.

The keys are those of yocs_cmd_vel_mux, so that a TurtleBot's own mux.yaml can be loaded.
"""

from __future__ import annotations

import re
from dataclasses import MISSING, dataclass
from typing import Any, Mapping

from fake_turtlebot_sim.mux.arbitration import IDLE
from node_kit.parameters.declaration import checked, number, parameter, text, whole_number

EXAMPLE = "as in subscribers: [{name: teleop, topic: input/teleop, timeout: 1.0, priority: 7}]"
_TOPIC = text(
    "the name of a topic, such as input/teleop",
    lambda value: re.fullmatch(r"/?[A-Za-z]\w*(/\w+)*", value, re.ASCII),
)
_NAME = text(
    f"a name other than {IDLE}, which means that no input is active",
    lambda value: value.strip() and value != IDLE,
)


@dataclass(frozen=True)
class Input:
    """An entry of ~subscribers: a topic of commands, with its priority."""

    name: str = parameter(MISSING, _NAME, "its name on `~active`")
    topic: str = parameter(MISSING, _TOPIC, "below the node's name, unless it begins with `/`")
    timeout: float = parameter(
        MISSING,
        number(0.02, 60.0, "s"),
        "how long the input stays active after its last command",
    )
    priority: int = parameter(
        MISSING,
        whole_number(0, allowed="a whole number, 0 for the lowest"),
        "the highest wins; no two are the same",
    )
    short_desc: str = parameter("", text(), "for people")


def _inputs(value: Any) -> tuple[Input, ...]:
    if not isinstance(value, (list, tuple)) or not value:
        raise ValueError(f"must be a list of inputs, {EXAMPLE}")
    inputs = tuple(_input(number, entry) for number, entry in enumerate(value, start=1))
    for key in ("name", "topic", "priority"):
        values = [getattr(item, key) for item in inputs]
        twice = next((v for k, v in enumerate(values) if v in values[:k]), None)
        if twice is not None:
            raise ValueError(f"{key}: {twice!r}: is listed twice; must be unique")
    return inputs


def _input(position: int, entry: Any) -> Input:
    where = f"entry {position}: "
    if not isinstance(entry, dict):
        raise ValueError(f"{where}{entry!r}: must be {EXAMPLE}")
    return Input(**checked(Input, entry, where, example=EXAMPLE))


@dataclass(frozen=True)
class MuxParameters:
    """The parameters with their defaults; see README.md and config/cmd_vel_mux.yaml."""

    subscribers: tuple[Input, ...] = parameter(MISSING, _inputs, "list of inputs")
    publisher: str = parameter("output", _TOPIC, "of the commands that go through")


def parse_mux_parameters(given: Mapping[str, Any]) -> MuxParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    parameters = MuxParameters(**checked(MuxParameters, given, example=EXAMPLE))
    publisher = parameters.publisher
    if publisher in [item.topic for item in parameters.subscribers]:
        raise ValueError(f"~publisher: {publisher!r}: must not be the topic of an input")
    return parameters
