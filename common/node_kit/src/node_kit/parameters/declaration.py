"""Private parameters: from a mapping of names to values to a checked, frozen dataclass.

Each field of a dataclass declares its default, what is allowed and what it is for:

    @dataclass(frozen=True)
    class Parameters:
        rate: float = parameter(50.0, number(5, 1000, "Hz"), "messages published")

checked() reports a mistake as `~rate: 0: must be a number from 5 to 1000 Hz`; table() returns the
README's table.
"""

from __future__ import annotations

import dataclasses
import difflib
from dataclasses import MISSING, Field, dataclass, fields
from math import inf
from sys import float_info
from typing import Any, Callable, Collection, Mapping


@dataclass(frozen=True)
class Allowed:
    """Which values are allowed, in words and as a test; keep() converts a good value."""

    allowed: str
    fits: Callable[[Any], object]
    keep: Callable[[Any], Any] = lambda value: value

    def __call__(self, value: Any) -> Any:
        """Return the value to keep. Raises ValueError ("must be ...")."""
        if not self.fits(value):
            raise ValueError(f"must be {self.allowed}")
        return self.keep(value)


def parameter(
    default: Any, check: Callable[[Any], Any], meaning: str = "", default_in_words: str = ""
) -> Any:
    """Declare a field of a dataclass of parameters; default: MISSING if there is none."""
    metadata = {"check": check, "meaning": meaning, "default": default_in_words}
    if isinstance(default, dict):  # so that no two instances share it
        return dataclasses.field(default_factory=lambda: dict(default), metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


def checked(
    kind: type, given: Mapping[str, Any], where: str = "~", example: str = ""
) -> dict[str, Any]:
    """Return {name: checked value} of the fields of the dataclass `kind`, defaults filled in.

    where: the text before each name. example: what to write if a value is missing. Raises
    ValueError, one line.
    """
    known = declared(kind)
    for name in given:
        if name not in known:
            raise ValueError(unknown(name, given[name], known, where))
    values = {}
    for name, declaration in known.items():
        if name in given:
            values[name] = checked_value(
                f"{where}{name}", given[name], declaration.metadata["check"]
            )
        else:
            values[name] = _default(declaration)
            if values[name] is MISSING:
                raise ValueError(f"{where}{name}: missing; {example}")
    return values


def _default(declaration: Field[Any]) -> Any:
    factory = declaration.default_factory
    return declaration.default if factory is MISSING else factory()


def declared(kind: type) -> dict[str, Field[Any]]:
    """Return the fields of a dataclass that parameter() declares, by name."""
    return {field.name: field for field in fields(kind) if "check" in field.metadata}


def checked_value(name: str, value: Any, check: Callable[[Any], Any]) -> Any:
    """Return the checked value. Raises ValueError, with the name and the value in it."""
    try:
        return check(value)
    except ValueError as error:
        raise ValueError(f"{name}: {value!r}: {error}") from None


def unknown(name: str, value: Any, known: Collection[str], where: str = "~") -> str:
    """Return one line about an unknown name: the nearest known name, or all of them."""
    similar = difflib.get_close_matches(str(name), known, n=1)
    if similar:
        hint = f"did you mean {'~' if where == '~' else ''}{similar[0]}?"
    else:
        hint = f"allowed: {', '.join(sorted(known))}"
    return f"{where}{name}: {value!r}: no such parameter; {hint}"


def table(kind: type, where: str = "~") -> str:
    """Return the Markdown table of the parameters that a dataclass declares; where: as above."""
    rows = ["| parameter | default | allowed | |", "|---|---|---|---|"]
    for name, declaration in declared(kind).items():
        about = declaration.metadata
        default = about["default"] or _as_yaml(_default(declaration))
        allowed = getattr(about["check"], "allowed", "")
        rows.append(f"| `{where}{name}` | {default} | {allowed} | {about['meaning']} |")
    return "\n".join(rows) + "\n"


def _as_yaml(value: Any) -> str:
    if value is MISSING:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value) or '""'


def is_whole(value: object) -> bool:
    """Return whether a value is a whole number; YAML's true and false are not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Return whether a value is a finite number that a float can hold."""
    return (isinstance(value, float) or is_whole(value)) and abs(value) <= float_info.max


def number(least: float, most: float, unit: str = "", off: Any = None) -> Allowed:
    """Allow a number from least to most, both included, or off. unit: the words after it."""
    allowed = f"a number from {least:g} to {most:g} {unit}".rstrip()
    return Allowed(
        allowed,
        lambda v: (is_number(v) and (least <= v <= most or v == off)) or v == off == "",
        lambda v: float(v) if is_number(v) else v,
    )


def whole_number(
    least: float = -inf, most: float = inf, allowed: str = "a whole number"
) -> Allowed:
    """Allow a whole number, within bounds where they are given. allowed: in words."""
    return Allowed(allowed, lambda value: is_whole(value) and least <= value <= most)


def text(allowed: str = "a text", fits: Callable[[str], object] = lambda value: True) -> Allowed:
    """Allow a text that fits. allowed: in words."""
    return Allowed(allowed, lambda value: isinstance(value, str) and fits(value))


switch = Allowed("true or false", lambda value: isinstance(value, bool))
