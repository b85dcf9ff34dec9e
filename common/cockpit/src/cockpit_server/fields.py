"""Messages of any type: their definitions, fields and numbers.

A field has a name such as pose/position/x or axes[0]. genpy has made the classes: __slots__ and
_slot_types declare their fields.
"""

from __future__ import annotations

import re
from functools import lru_cache
from math import isfinite
from typing import Any, Iterable, Iterator, Sequence

from node_kit.message_types import message_class

MOST_ENTRIES = 2000  # A longer array is cut.
_CONSTANT = re.compile(r"^\s*(\w+)\s+(\w+)\s*=\s*(.*?)\s*$", re.MULTILINE)
_PART = re.compile(r"([A-Za-z]\w*)(?:\[(\d{1,6})\])?")


def slots_of(kind: Any) -> Iterator[tuple[str, str]]:
    """Return the (name, type) of each field of a class."""
    return zip(kind.__slots__, kind._slot_types)


@lru_cache(maxsize=2000)
def numbers_of(type_name: str) -> tuple[str, ...]:
    """Return the names of all numbers in messages of a type; rarely drawn ones come last.

    An array is one name, as its length is unknown; an array of messages has those of its first.
    """
    names: list[str] = []
    kind = message_class(type_name)
    for name, slot_type in slots_of(kind) if kind else ():
        base, is_array, _ = slot_type.partition("[")
        first = f"{name}[0]" if is_array else name
        names += [f"{first}/{inner}" for inner in numbers_of(base)]
        if "/" not in base and base != "string":
            names.append(name)
    return tuple(sorted(names, key=lambda name: "header/" in name or "covariance" in name))


def definition(kind: Any, indent: str = "") -> Iterator[str]:
    """Yield the lines that rosmsg show prints."""
    for base, name, value in _CONSTANT.findall(kind._full_text.split("=" * 80)[0]):
        shown = value if base == "string" else value.partition("#")[0].strip()
        yield f"{indent}{base} {name}={shown}"
    for name, slot_type in slots_of(kind):
        yield f"{indent}{slot_type} {name}"
        inner = message_class(slot_type.partition("[")[0])
        if inner:
            yield from definition(inner, f"{indent}  ")


def form_fields(kind: Any, above: str = "") -> Iterator[tuple[str, str]]:
    """Yield (name, type) of the fields of a form; an array is one field."""
    for name, slot_type in slots_of(kind):
        inner = message_class(slot_type)
        if inner:
            yield from form_fields(inner, f"{above}{name}/")
        elif f"{above}{name}" != "header/seq":  # rospy counts
            yield f"{above}{name}", slot_type


def parts_of(field: str) -> list[tuple[str, int | None]]:
    """Return [(name, index or None)] of a field's name, or [] if malformed."""
    words = field.split("/")
    parts = [part for part in map(_PART.fullmatch, words) if part]
    if len(parts) < len(words):
        return []
    return [(part[1], None if part[2] is None else int(part[2])) for part in parts]


def value_at(
    message: Any, parts: Sequence[tuple[str, int | None]]
) -> float | list[float | None] | None:
    """Return the finite number at parts_of(FIELD), the numbers of a whole array, or None."""
    for name, index in parts:
        if name not in getattr(message, "__slots__", ()):
            return None
        message = getattr(message, name)
        if index is not None:
            if not isinstance(message, (list, tuple, bytes)) or index >= len(message):
                return None
            message = message[index]
    if isinstance(message, (list, tuple, bytes)):
        return [finite(entry) for entry in message[:MOST_ENTRIES]]
    return finite(message)


def finite(value: Any) -> float | None:
    """Return a number or a time of ROS as a float, or None."""
    if hasattr(value, "to_sec"):
        return float(value.to_sec())
    return float(value) if isinstance(value, (int, float)) and isfinite(value) else None


def split(field: str, topics: Iterable[str]) -> tuple[str, str]:
    """Return (topic, rest) of a field; the topic is "" if it is of none of the topics."""
    fitting = (topic for topic in topics if field.startswith(f"{topic}/"))
    topic = max(fitting, key=len, default="")
    return topic, field[len(topic) + 1 :]
