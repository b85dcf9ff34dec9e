"""Private parameters: from a mapping of names to values to a checked, frozen dataclass (pure).

Each field of a dataclass declares its default, what is allowed and what it is for:

    @dataclass(frozen=True)
    class Parameters:
        rate: float = parameter(50.0, number(5, 1000, "Hz"), "messages published")

checked() reports a mistake as `~rate: 0: must be a number from 5 to 1000 Hz`; table() returns the
README's table.
"""

from __future__ import annotations

import difflib
from dataclasses import MISSING, Field, dataclass, field, fields
from math import inf
from sys import float_info
from typing import Any, Callable, Collection, Mapping


@dataclass(frozen=True)
class Check:
    """What a value must be, in words, and how this is decided; keep() converts a good value."""

    allowed: str
    fits: Callable[[Any], object]
    keep: Callable[[Any], Any] = lambda value: value

    def __call__(self, value: Any) -> Any:
        """Return what to keep of a value. Raises ValueError ("must be ...")."""
        if not self.fits(value):
            raise ValueError(f"must be {self.allowed}")
        return self.keep(value)


def parameter(
    default: Any, check: Callable[[Any], Any], meaning: str = "", default_in_words: str = ""
) -> Any:
    """Declare a field of a dataclass of parameters; default: MISSING if there is none."""
    metadata = {"check": check, "meaning": meaning, "default": default_in_words}
    if isinstance(default, dict):  # each dataclass has one of its own
        return field(default_factory=lambda: dict(default), metadata=metadata)
    return field(default=default, metadata=metadata)


def checked(
    kind: type, given: Mapping[str, Any], where: str = "~", example: str = ""
) -> dict[str, Any]:
    """Return {name: checked value} of the fields of the dataclass `kind`, defaults filled in.

    where: stands before each name. example: what to write where a value is missing. Raises
    ValueError, one line.
    """
    known = declared(kind)
    for name in given:
        if name not in known:
            raise ValueError(unknown(name, given[name], known, where))
    values = {}
    for name, one in known.items():
        if name in given:
            values[name] = checked_value(f"{where}{name}", given[name], one.metadata["check"])
        else:
            values[name] = _default(one)
            if values[name] is MISSING:
                raise ValueError(f"{where}{name}: missing; {example}")
    return values


def _default(one: Field[Any]) -> Any:
    return one.default if one.default_factory is MISSING else one.default_factory()


def declared(kind: type) -> dict[str, Field[Any]]:
    """Return the fields of a dataclass that parameter() declares, by name."""
    return {one.name: one for one in fields(kind) if "check" in one.metadata}


def checked_value(name: str, value: Any, check: Callable[[Any], Any]) -> Any:
    """Return what the check keeps of the value; its ValueError gets the name and the value."""
    try:
        return check(value)
    except ValueError as error:
        raise ValueError(f"{name}: {value!r}: {error}") from None


def unknown(name: str, value: Any, known: Collection[str], where: str = "~") -> str:
    """Return one line about a name that does not exist, with the nearest one or all."""
    similar = difflib.get_close_matches(str(name), known, n=1)
    if similar:
        hint = f"did you mean {'~' if where == '~' else ''}{similar[0]}?"
    else:
        hint = f"allowed: {', '.join(sorted(known))}"
    return f"{where}{name}: {value!r}: no such parameter; {hint}"


def table(kind: type, where: str = "~") -> str:
    """Return the Markdown table of the parameters that a dataclass declares; where: as above."""
    rows = ["| parameter | default | allowed | |", "|---|---|---|---|"]
    for name, one in declared(kind).items():
        default = one.metadata["default"] or _as_yaml(_default(one))
        allowed = getattr(one.metadata["check"], "allowed", "")
        rows.append(f"| `{where}{name}` | {default} | {allowed} | {one.metadata['meaning']} |")
    return "\n".join(rows) + "\n"


def _as_yaml(value: Any) -> str:
    if value is MISSING:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value) or '""'


def is_whole(value: object) -> bool:
    """Return whether it is a whole number; YAML's true and false are not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Return whether it is a finite number that a float can hold."""
    return (isinstance(value, float) or is_whole(value)) and abs(value) <= float_info.max


def number(least: float, most: float, unit: str = "", off: Any = None) -> Check:
    """Allow a number from least to most, both included, or off. unit: what follows in the text."""
    allowed = f"a number from {least:g} to {most:g} {unit}".rstrip()
    return Check(
        allowed,
        lambda v: (is_number(v) and (least <= v <= most or v == off)) or v == off == "",
        lambda v: float(v) if is_number(v) else v,
    )


def whole_number(least: float = -inf, most: float = inf, allowed: str = "a whole number") -> Check:
    """Allow a whole number, within bounds where they are given. allowed: the words for them."""
    return Check(allowed, lambda value: is_whole(value) and least <= value <= most)


def text(allowed: str = "a text", fits: Callable[[str], object] = lambda value: True) -> Check:
    """Allow a text that fits. allowed: the words for what does."""
    return Check(allowed, lambda value: isinstance(value, str) and fits(value))


switch = Check("true or false", lambda value: isinstance(value, bool))
