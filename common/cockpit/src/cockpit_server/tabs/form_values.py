"""Forms on pages: what they ask for, and what a person writes into them."""

from __future__ import annotations

import json
import re
from typing import Any, Iterable, Mapping, Sequence

from cockpit_server.expressions import value_of
from cockpit_server.fields import form_fields
from node_kit.parameters.declaration import Allowed

MOST_VALUES, SHORT = 1000, 60  # parameters in a list, and characters of the value of each
MOST_FIELDS = 60  # fields in a form
LONGEST_VALUE = 2000  # characters
LONGEST_ANSWER, LONGEST_LINE = 4000, 200  # characters
_NUMBERS = re.compile(r"(u?int\d+|float\d+|byte|char|bool)(\[\d*\])?")

TEXTS = Allowed(
    f"at most {MOST_FIELDS} texts of at most {LONGEST_VALUE} characters",
    lambda v: isinstance(v, dict) and len(v) <= MOST_FIELDS
    and all(isinstance(text, str) and len(text) <= LONGEST_VALUE for text in v.values()),
)  # fmt: skip


def one_line(error: Exception) -> str:
    return " ".join(str(error).split())[:LONGEST_LINE] or type(error).__name__


def form(
    name: str, lines: Iterable[str], fields: Iterable[tuple[str, str]], numbers: Sequence[str] = ()
) -> dict[str, Any]:
    """Return the message with a form. lines: of the definition. fields: (name, type)."""
    content = {"definition": "\n".join(lines), "fields": list(fields)[:MOST_FIELDS]}
    return {"kind": "form", "name": name, "numbers": numbers, **content}


def field_values(kind: Any, texts: Mapping[str, str], i: int, now_s: float) -> dict[str, Any]:
    """Return the values of a form by field, nested as in a message of this class.

    i, now_s: number and time of the message, for expressions. Raises ValueError, one line.
    """
    types = dict(form_fields(kind))
    tree: dict[str, Any] = {}
    for name, text in texts.items():
        if name not in types:
            raise ValueError(f"{kind._type} has no field {name[:60]!r}")
        part = tree
        *above, last = name.split("/")
        for step in above:
            part = part.setdefault(step, {})
        part[last] = field_value(name, types[name], text, i, now_s)
    return tree


def field_value(name: str, slot_type: str, text: str, i: int, now_s: float) -> Any:
    """Return the value of a field as genpy fills it in. Raises ValueError, one line."""
    if slot_type == "string" or text == "now":
        return text
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        if not _NUMBERS.fullmatch(slot_type):
            wanted = "JSON, as 0.5, true or [1, 2]"
            raise ValueError(f"{name}: {slot_type} must be {wanted}") from None
    try:
        return value_of(text, float if slot_type.startswith("float") else int, i, now_s)
    except Exception as error:  # whatever Python says about a hostile text
        wanted = f"{name}: {slot_type} must be a number, or an expression as sin(i / 10)"
        why = getattr(error, "msg", "") or one_line(error)  # without a SyntaxError's line
        raise ValueError(f"{wanted}: {why}") from None


def parameter_value(text: str) -> Any:
    """Return the value of a parameter as rosparam reads it: JSON, or else the text itself."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def parameter_values(tree: Any) -> dict[str, Any]:
    """Return the message with the values of all parameters, abbreviated."""
    values = {name: _abbreviated(value) for name, value in _leaves("", tree)}
    return {"kind": "values", "values": dict(list(values.items())[:MOST_VALUES])}


def _leaves(above: str, value: Any) -> Iterable[tuple[str, Any]]:
    """Yield (name, value) of the parameters in a tree, with the names of rosparam list."""
    if not isinstance(value, dict) or not value:
        yield above or "/", value
        return
    for name, inner in value.items():
        yield from _leaves(f"{above}/{name}", inner)


def _abbreviated(value: Any) -> str:
    written = json.dumps(value, default=str)
    return written if len(written) <= SHORT else f"{written[: SHORT - 4]} ..."
