"""Private parameters: from a mapping of names to values to a checked, frozen dataclass (pure).

A dataclass says for each of its fields what is allowed:

    @dataclass(frozen=True)
    class Parameters:
        rate: float = parameter(50.0, number(5, 1000, "Hz"))

A check takes a value and returns what to keep of it, or raises ValueError with the words "must be
...". checked() puts the name and the value before them, so that every complaint of every node is
one line of the same form: `~rate: 0: must be a number from 5 to 1000 Hz`.
"""

import difflib
from dataclasses import MISSING, field, fields
from math import inf
from sys import float_info


def parameter(default, check, **more):
    """A field of a dataclass of parameters. default: MISSING if there is none."""
    metadata = {"check": check, **more}
    if isinstance(default, dict):  # each dataclass has one of its own
        return field(default_factory=lambda: dict(default), metadata=metadata)
    return field(default=default, metadata=metadata)


def checked(kind, given, where="~", others=(), example=""):
    """{name: checked value} of the fields of the dataclass `kind`, defaults filled in.

    where: stands before each name. others: names that are known, too, but checked elsewhere.
    example: what to write where a value is missing. Raises ValueError, one line.
    """
    known = {f.name: f for f in fields(kind) if "check" in f.metadata}
    for name in given:
        if name not in known and name not in others:
            raise ValueError(unknown(name, given[name], [*known, *others], where))
    values = {}
    for name, one in known.items():
        if name in given:
            values[name] = checked_value(f"{where}{name}", given[name], one.metadata["check"])
        elif one.default_factory is not MISSING:
            values[name] = one.default_factory()
        elif one.default is MISSING:
            raise ValueError(f"{where}{name}: missing; {example}")
        else:
            values[name] = one.default
    return values


def checked_value(name, value, check):
    """What the check makes of the value. Raises ValueError, with the name and the value first."""
    try:
        return check(value)
    except ValueError as error:
        raise ValueError(f"{name}: {value!r}: {error}") from None


def unknown(name, value, known, where="~"):
    """One line about a name that does not exist: which may have been meant, or which there are."""
    similar = difflib.get_close_matches(str(name), known, n=1)
    if similar:
        hint = f"did you mean {'~' if where == '~' else ''}{similar[0]}?"
    else:
        hint = f"allowed: {', '.join(sorted(known))}"
    return f"{where}{name}: {value!r}: no such parameter; {hint}"


def is_whole(value):
    """Whether it is a whole number; YAML's true and false are none."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value):
    """Whether it is a finite number; a whole one that is too large for a float is none."""
    return (isinstance(value, float) or is_whole(value)) and abs(value) <= float_info.max


def number(least, most, unit="", off=None):
    """A number from least to most, both included, or off. unit: what follows in the text."""

    def check(value):
        if not is_number(value) or not (least <= value <= most or value == off):
            raise ValueError(f"must be a number from {least:g} to {most:g} {unit}".rstrip())
        return float(value)

    return check


def whole_number(least=-inf, most=inf, allowed="a whole number"):
    """A whole number, within bounds where they are given. allowed: the words for them."""

    def check(value):
        if not is_whole(value) or not least <= value <= most:
            raise ValueError(f"must be {allowed}")
        return value

    return check


def switch(value):
    """A check: true or false."""
    if not isinstance(value, bool):
        raise ValueError("must be true or false")
    return value


def text(allowed="a text", fits=lambda value: True):
    """A text that fits. allowed: the words for what does."""

    def check(value):
        if not isinstance(value, str) or not fits(value):
            raise ValueError(f"must be {allowed}")
        return value

    return check
