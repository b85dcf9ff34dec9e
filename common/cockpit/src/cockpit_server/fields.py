"""What is in messages of any type: their definitions, fields, and numbers, by names such as
pose/position/x or axes[0] (pure).

A message class is one that genpy made: __slots__ and _slot_types say what is in it.
"""

from __future__ import annotations

import re
from math import isfinite
from typing import Any, Callable, Iterable, Iterator, Sequence

NUMBERS = {
    "bool", "byte", "char", "float32", "float64", "int16", "int32", "int64", "int8", "uint16",
    "uint32", "uint64", "uint8", "time", "duration",
}  # fmt: skip
MOST_ENTRIES = 2000  # A longer array is cut.
DEEPEST = 8
_CONSTANT = re.compile(r"^\s*(\w+)\s+(\w+)\s*=\s*(.*?)\s*$", re.MULTILINE)
_PART = re.compile(r"([A-Za-z]\w*)(?:\[(\d{1,6})\])?")


def numeric_fields(
    kind: Any, class_of: Callable[[str], Any], depth: int = DEEPEST
) -> Iterator[str]:
    """Yield the names of a class's numbers. class_of: type name -> class or None.

    An array is one name, as only messages have its length; of messages, the first one's numbers.
    """
    if depth == 0:
        return
    for name, slot_type in zip(kind.__slots__, kind._slot_types):
        base, is_array, _ = slot_type.partition("[")
        if base in NUMBERS:
            yield name
        elif base != "string":
            inner, first = class_of(base), f"{name}[0]" if is_array else name
            inside = numeric_fields(inner, class_of, depth - 1) if inner else ()
            yield from (f"{first}/{one}" for one in inside)


def definition(kind: Any, class_of: Callable[[str], Any], indent: str = "") -> Iterator[str]:
    """Yield the lines that rosmsg show prints."""
    for base, name, value in _CONSTANT.findall(kind._full_text.split("=" * 80)[0]):
        shown = value if base == "string" else value.partition("#")[0].strip()
        yield f"{indent}{base} {name}={shown}"
    for name, slot_type in zip(kind.__slots__, kind._slot_types):
        yield f"{indent}{slot_type} {name}"
        base = slot_type.partition("[")[0]
        inner = base not in NUMBERS and class_of(base)
        if inner:
            yield from definition(inner, class_of, f"{indent}  ")


def form_fields(
    kind: Any, class_of: Callable[[str], Any], above: str = ""
) -> Iterator[tuple[str, str]]:
    """Yield (name, type) of what a form asks for; an array is one field."""
    for name, slot_type in zip(kind.__slots__, kind._slot_types):
        inner = slot_type not in NUMBERS and class_of(slot_type)
        if inner:
            yield from form_fields(inner, class_of, f"{above}{name}/")
        elif f"{above}{name}" != "header/seq":  # rospy counts
            yield f"{above}{name}", slot_type


def parts_of(field: str) -> list[tuple[str, int | None]]:
    """Return [(name, index or None)] of a field's name. Raises ValueError."""
    words = field.split("/")
    parts = [part for part in map(_PART.fullmatch, words) if part]
    if len(parts) < len(words) or len(parts) > DEEPEST:
        raise ValueError(f"{field!r} is no field: write it as pose/position/x or axes[0]")
    return [(part[1], None if part[2] is None else int(part[2])) for part in parts]


def value_at(
    message: Any, parts: Sequence[tuple[str, int | None]]
) -> float | list[float | None] | None:
    """Return the finite number at parts_of(...), those of a whole array, or None."""
    for name, index in parts:
        if name not in getattr(message, "__slots__", ()):
            return None
        message = getattr(message, name)
        if index is not None:
            if not isinstance(message, (list, tuple, bytes)) or index >= len(message):
                return None
            message = message[index]
    if isinstance(message, (list, tuple, bytes)):
        return [finite(one) for one in message[:MOST_ENTRIES]]
    return finite(message)


def finite(value: Any) -> float | None:
    """Return a number or a time of ROS as a float, or None."""
    if hasattr(value, "to_sec"):
        return float(value.to_sec())
    return float(value) if isinstance(value, (int, float)) and isfinite(value) else None


def split(field: str, topics: Iterable[str]) -> tuple[str, str]:
    """Return (topic, rest) of a field of one of the topics. Raises ValueError."""
    fitting = [topic for topic in topics if field.startswith(f"{topic}/")]
    if not fitting:
        raise ValueError(f"{field!r} belongs to no topic that is published")
    topic = max(fitting, key=len)
    return topic, field[len(topic) + 1 :]
