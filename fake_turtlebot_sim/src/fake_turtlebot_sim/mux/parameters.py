"""Private parameters of cmd_vel_mux: a mapping in, a checked and frozen MuxParameters out.

The keys are those of yocs_cmd_vel_mux, so that a TurtleBot's own mux.yaml can be loaded.
"""

import difflib
import re
from dataclasses import MISSING, dataclass, fields
from math import isfinite
from typing import Tuple

from fake_turtlebot_sim.mux.arbitration import IDLE, Input

TIMEOUTS_S = (0.02, 60.0)  # least, most
EXAMPLE = "{name: teleop, topic: input/teleop, timeout: 1.0, priority: 7}"


@dataclass(frozen=True)
class MuxParameters:
    """What can be set, with the defaults; README.md and config/cmd_vel_mux.yaml explain each."""

    subscribers: Tuple[Input, ...]
    publisher: str = "output"


def parse_mux_parameters(given):
    """Return MuxParameters from a mapping of names to values.

    Raises ValueError with one line: the parameter, its value and what is allowed.
    """
    checked = _fields("~", given, MuxParameters, {"subscribers": _inputs, "publisher": _topic})
    parameters = MuxParameters(**checked)
    for one in parameters.subscribers:
        if one.topic == parameters.publisher:
            raise ValueError(f"~publisher: {one.topic!r}: must not be the topic of an input")
    return parameters


def _fields(where, given, kind, checks):
    """Return {field: checked value} for the dataclass `kind`; `where` begins every complaint."""
    known = {field.name: field.default for field in fields(kind)}
    for name, value in given.items():
        if name not in known:
            similar = difflib.get_close_matches(str(name), known, n=1)
            hint = f"did you mean {similar[0]}?" if similar else f"allowed: {', '.join(known)}"
            raise ValueError(f"{where}{name}: {value!r}: unknown; {hint}")
    for name, default in known.items():
        if default is MISSING and name not in given:
            raise ValueError(f"{where}{name}: missing; as in subscribers: [{EXAMPLE}]")
    return {name: checks[name](f"{where}{name}: {value!r}", value) for name, value in given.items()}


def _inputs(what, value):
    if not isinstance(value, (list, tuple)) or not value:
        raise ValueError(f"{what}: must be a list of inputs, as in [{EXAMPLE}]")
    inputs = tuple(_input(number, entry) for number, entry in enumerate(value, start=1))
    for key in ("name", "topic", "priority"):
        values = [getattr(one, key) for one in inputs]
        twice = next((v for k, v in enumerate(values) if v in values[:k]), None)
        if twice is not None:
            raise ValueError(f"~subscribers: {key}: {twice!r}: stands there twice; must be unique")
    return inputs


def _input(number, entry):
    where = f"~subscribers: entry {number}: "
    if not isinstance(entry, dict):
        raise ValueError(f"{where}{entry!r}: must be as in {EXAMPLE}")
    return Input(**_fields(where, entry, Input, _CHECKS))


def _name(what, value):
    if not isinstance(value, str) or not value.strip() or value == IDLE:
        raise ValueError(f"{what}: must be a name, and not {IDLE}, which means that none is active")
    return value


def _topic(what, value):
    if not isinstance(value, str) or not re.fullmatch(r"/?[A-Za-z]\w*(/\w+)*", value, re.ASCII):
        raise ValueError(f"{what}: must be the name of a topic, such as input/teleop")
    return value


def _timeout(what, value):
    least, most = TIMEOUTS_S
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not isfinite(value) or not least <= value <= most:
        raise ValueError(f"{what}: must be a number from {least:g} to {most:g} s")
    return float(value)


def _priority(what, value):
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise ValueError(f"{what}: must be a whole number, 0 for the lowest")
    return value


def _text(what, value):
    if not isinstance(value, str):
        raise ValueError(f"{what}: must be a text")
    return value


def _switch(what, value):
    if not isinstance(value, bool):
        raise ValueError(f"{what}: must be true or false")
    return value


_CHECKS = {
    "name": _name,
    "topic": _topic,
    "timeout": _timeout,
    "priority": _priority,
    "short_desc": _text,
    "rearm_on_zero": _switch,
}
