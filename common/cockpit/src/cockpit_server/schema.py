"""What a page may say: each message's fields and their bounds (pure).

check_message() gives what is as it should be, and raises ValueError with one line for all else.
"""

import json

from gamepad.gamepads import F710
from node_kit.parameters import is_number, is_whole

LONGEST_MESSAGE = 8192  # bytes; the longest that a page sends is a watch with MOST_FIELDS
LONGEST_TEXT = 200
MOST_FIELDS = 20
LARGEST = 2**53 - 1  # up to here JavaScript's numbers are whole
MODES = tuple(F710)
SOURCES = ("pad", "touch", "keys")


def whole(value):
    if not is_whole(value) or not 0 <= value <= LARGEST:
        raise ValueError("must be a whole number from 0")
    return value


def number(least, most):
    def check(value):
        if not is_number(value) or not least <= value <= most:
            raise ValueError(f"must be a number from {least:g} to {most:g}")
        return float(value)

    return check


def text(value):
    if not isinstance(value, str) or len(value) > LONGEST_TEXT or not value.isprintable():
        raise ValueError(f"must be a text of at most {LONGEST_TEXT} characters")
    return value


def full_name(value):
    """A name of the graph with its namespace: rospy would take "x" for one beside the cockpit."""
    if not text(value).startswith("/"):
        raise ValueError("must begin with /")
    return value


def switch(value):
    if not isinstance(value, bool):
        raise ValueError("must be true or false")
    return value


def one_of(*values):
    def check(value):
        if value not in values or not isinstance(value, str):
            raise ValueError(f"must be {', '.join(values)}")
        return value

    return check


def or_null(check):
    return lambda value: None if value is None else check(value)


def list_of(check, most):
    def check_all(value):
        if not isinstance(value, list) or len(value) > most:
            raise ValueError(f"must be a list of at most {most}")
        return tuple([check(one) for one in value])

    return check_all


MOST_AXES = max(len(pad.axes) for pad in F710.values())
MOST_BUTTONS = max(len(pad.buttons) for pad in F710.values())


def pressed(value):
    if value not in (0, 1) or not is_whole(value):
        raise ValueError("must be 0 or 1")
    return value


MILLISECONDS = number(0, 1e15)
MESSAGES = {
    "watch": {
        "robots": switch,
        "look": or_null(text),
        "graph": switch,
        "topic": or_null(full_name),
        "node": or_null(full_name),
        "fields": list_of(text, MOST_FIELDS),
        "field_list": switch,
        "log": switch,
        "bag": switch,
    },
    "drive": {"robot": text, "mode": one_of(*MODES)},
    "leave": {},
    "hand_over": {"to": whole},
    "input": {
        "n": whole,
        "t": MILLISECONDS,
        "beat": whole,
        "axes": list_of(number(-1, 1), MOST_AXES),
        "buttons": list_of(pressed, MOST_BUTTONS),
        "pad": or_null(MILLISECONDS),
        "source": one_of(*SOURCES),
    },
    "release": {"why": text},
    "reset": {"robot": text},
    "bag_open": {"name": text},
    "bag_play": {"topic": text, "rate": number(0.1, 10), "loop": switch, "robot": text},
    "bag_pause": {},
    "bag_seek": {"position": number(0, 1e6)},
    "doctor": {},
}


def check_message(data):
    """(kind, {field: value}) of a message. Raises ValueError, one line."""
    if not isinstance(data, str):
        raise ValueError("a message must be a text")
    if len(data) > LONGEST_MESSAGE:
        raise ValueError(f"a message must have at most {LONGEST_MESSAGE} characters")
    try:
        given = json.loads(data)
    except (ValueError, RecursionError):
        raise ValueError("a message must be JSON") from None
    if not isinstance(given, dict) or not isinstance(given.get("kind"), str):
        raise ValueError('a message must be an object with "kind"')
    kind = given.pop("kind")
    if kind not in MESSAGES:
        raise ValueError(f"no such kind of message: {_shown(kind)}")
    fields = MESSAGES[kind]
    for name in given:
        if name not in fields:
            raise ValueError(f"{kind} has no field {_shown(name)}")
    values = {}
    for name, check in fields.items():
        if name not in given:
            raise ValueError(f"{kind} lacks {name}")
        try:
            values[name] = check(given[name])
        except ValueError as error:
            raise ValueError(f"{kind}: {name} {error}") from None
    return kind, values


def check_lengths(modes, axes, buttons):
    """Raise ValueError unless these are as many as the gamepad in one of the modes has."""
    allowed = {mode: (len(F710[mode].axes), len(F710[mode].buttons)) for mode in modes}
    if (len(axes), len(buttons)) not in allowed.values():
        has = [f"{mode} mode has {a} axes and {b} buttons" for mode, (a, b) in allowed.items()]
        raise ValueError(f"input: {' and '.join(has)}")


def _shown(word):
    return repr(word[:40])
