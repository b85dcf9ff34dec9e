"""The messages that pages may send, with their fields and bounds.

The check of a field returns the value to use, or raises ValueError with one line.
"""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any, Callable, Mapping, Sequence

from cockpit_server.limits import LONGEST_MESSAGE
from gamepad.gamepads import F710
from node_kit.parameters import declaration

LONGEST_TEXT = 200
MOST_FIELDS = 20
LARGEST = 2**53 - 1  # JavaScript's largest safe integer
MODES = tuple(F710)
MOST_AXES = max(len(pad.axes) for pad in F710.values())
MOST_BUTTONS = max(len(pad.buttons) for pad in F710.values())
WATCH = "watch"

Check = Callable[[Any], Any]
switch, number = declaration.switch, declaration.number
whole = declaration.whole_number(0, LARGEST, "a whole number from 0")
pressed = declaration.whole_number(0, 1, "0 or 1")
text = declaration.text(
    f"a text of at most {LONGEST_TEXT} characters",
    lambda v: len(v) <= LONGEST_TEXT and v.isprintable(),
)


def full_name(value: Any) -> Any:
    """Return an absolute name. Raises ValueError for one that rospy would resolve to another."""
    if not text(value).startswith("/"):
        raise ValueError("must begin with /")
    return value


def one_of(*values: str) -> Check:
    return declaration.text(", ".join(values), values.__contains__)


def or_null(check: Check) -> Check:
    return lambda value: None if value is None else check(value)


def list_of(check: Check, most: int) -> Check:
    return declaration.Allowed(
        f"a list of at most {most}",
        lambda v: isinstance(v, list) and len(v) <= most,
        lambda v: tuple([check(value) for value in v]),
    )


MILLISECONDS = number(0, 1e15)
INPUT: dict[str, Check] = {
    "n": whole,
    "t": MILLISECONDS,
    "beat": whole,
    "axes": list_of(number(-1, 1), MOST_AXES),
    "buttons": list_of(pressed, MOST_BUTTONS),
    "pad": or_null(MILLISECONDS),
    "source": one_of("pad", "touch", "keys"),
}


class Schema:
    """All messages that pages may send: those that sources declare, and watch."""

    def __init__(self, sources: Sequence[Any]) -> None:
        watches = {name: pair for source in sources for name, pair in source.watches.items()}
        self._nothing = {name: value for name, (_, value) in watches.items()}
        self._watch = {name: check for name, (check, _) in watches.items()}
        self.messages: dict[str, Mapping[str, Check]] = {WATCH: self._watch}
        for source in sources:
            self.messages.update(source.messages)

    def watch(self, **fields: Any) -> SimpleNamespace:
        """Return what a page watches; a field that it does not name shows nothing."""
        return SimpleNamespace(**{**self._nothing, **fields})

    def check(self, data: Any) -> tuple[str, dict[str, Any]]:
        """Return (kind, {field: value}) of a message. Raises ValueError, one line."""
        if not isinstance(data, str):
            raise ValueError("a message must be a text")
        if len(data) > LONGEST_MESSAGE:
            raise ValueError(f"a message must have at most {LONGEST_MESSAGE} characters")
        try:
            fields = json.loads(data)
        except (ValueError, RecursionError):
            raise ValueError("a message must be JSON") from None
        if not isinstance(fields, dict) or not isinstance(fields.get("kind"), str):
            raise ValueError('a message must be an object with "kind"')
        kind = fields.pop("kind")
        if kind not in self.messages:
            raise ValueError(f"no such kind of message: {kind[:40]!r}")
        checks = self.messages[kind]
        for name in checks:
            if name not in fields and checks is not self._watch:
                raise ValueError(f"{kind} lacks {name}")
        for name, value in fields.items():
            if name not in checks:
                raise ValueError(f"{kind} has no field {name[:40]!r}")
            try:
                fields[name] = checks[name](value)
            except ValueError as error:
                raise ValueError(f"{kind}: {name} {error}") from None
        return kind, fields


def check_lengths(modes: Sequence[str], axes: Sequence[float], buttons: Sequence[int]) -> None:
    """Raise ValueError unless a gamepad in one of the modes has as many axes and buttons."""
    allowed = {mode: (len(F710[mode].axes), len(F710[mode].buttons)) for mode in modes}
    if (len(axes), len(buttons)) not in allowed.values():
        has = [f"{mode} mode has {a} axes and {b} buttons" for mode, (a, b) in allowed.items()]
        raise ValueError(f"input: {' and '.join(has)}")
