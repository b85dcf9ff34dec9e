"""What pages may say: the messages that the hub and the sources declare, and their bounds."""

import json

import pytest

import cockpit_server.ros.cockpit_node  # noqa: F401  which imports every source
from cockpit_server.pages import TabSource
from cockpit_server.schema import Schema, check_lengths
from tutorial_testing.claims import claim
from tutorial_testing.socket_page import GOOD

pytestmark = claim("Messages have a fixed schema with bounds")
SOURCES = [s for s in TabSource.__subclasses__() if s.__module__.startswith("cockpit_server.")]
SCHEMA = Schema(SOURCES)
LONG = "x" * 41


def say(kind, **fields):
    return json.dumps({"kind": kind, **fields})


def taken(kind, name, value):
    """Return a field's value as it is kept, or the reason why it is refused."""
    try:
        return SCHEMA.check(say(kind, **{**GOOD[kind], name: value}))[1][name]
    except ValueError as error:
        assert len(str(error)) < 200 and "\n" not in str(error)
        return str(error)


@pytest.mark.parametrize("kind", SCHEMA.messages)
def test_each_field_is_required_and_others_are_refused(kind):
    assert SCHEMA.check(say(kind, **GOOD[kind]))[0] == kind
    assert not any(vars(SCHEMA.watch()).values())  # what a page does not ask for
    with pytest.raises(ValueError, match=f"has no field '{LONG[:40]}'$"):
        SCHEMA.check(say(kind, **GOOD[kind], **{LONG: 1}))
    for name in SCHEMA.messages[kind] if kind != "watch" else ():
        with pytest.raises(ValueError, match=f"{kind} lacks {name}"):
            SCHEMA.check(say(kind, **{n: v for n, v in GOOD[kind].items() if n != name}))


@pytest.mark.parametrize(
    "data",
    [
        b"{}", "", "null", "{", '{"kind": 1}', '{"kind": "command"}', "[" * 5000,
        say("stop").ljust(8193), '{"kind": ["stop"]}',
    ],
)  # fmt: skip
def test_malformed_message_is_refused_and_the_longest_taken(data):
    assert SCHEMA.check(say("stop").ljust(8192)) == ("stop", {})
    with pytest.raises(ValueError, match="message"):
        SCHEMA.check(data)
    with pytest.raises(ValueError, match=f"no such kind of message: '{LONG[:40]}'$"):
        SCHEMA.check(say(LONG))


WHOLE, UP_TO = "must be a whole number from 0", "must be a number from"


# The outermost values that are accepted, and the first ones beyond them, with the reason.
@pytest.mark.parametrize(
    ("field", "good", "bad", "why"),
    [
        ("input n", [0, 2**53 - 1], [-1, 2**53, 1.0], WHOLE),
        ("input t", [0.0, 1e15], [-0.001, 1e15 + 1, 10**400], f"{UP_TO} 0 to 1e+15"),
        ("input pad", [None, 0.0, 1e15], [-0.001, 1e15 + 1], f"{UP_TO} 0 to 1e+15"),
        ("input axes", [(), (-1.0,) * 8, (1.0,) * 8],
         [[1.01], [-2], ["0"], [True], [None], [float("nan")], [float("inf")], [10**400]],
         f"{UP_TO} -1 to 1"),
        ("input axes", [], [[0] * 9, 1, "0"], "must be a list of at most 8"),
        ("input buttons", [(), (0,) * 12, (1,) * 12], [[2], [-1], [True], [0.5]], "must be 0 or 1"),
        ("input buttons", [], [[0] * 13, "1"], "must be a list of at most 12"),
        ("input source", ["pad", "touch", "keys"], ["mouse"], "must be pad, touch, keys"),
        ("bag_play rate", [0.1, 10.0], [0.099, 10.01], f"{UP_TO} 0.1 to 10"),
        ("bag_seek position", [0.0, 1e6], [-0.001, 1000000.1], f"{UP_TO} 0 to 1e+06"),
        ("release why", ["", "x" * 200], ["x" * 201, None, "a\nb"],
         "must be a text of at most 200 characters"),
        ("watch topic", [None, "/", "/" + "x" * 199], ["", "odom"], "must begin with /"),
        ("watch fields", [("/a/x",) * 20], [["/a/x"] * 21], "must be a list of at most 20"),
        ("watch frames", [None, (), ("odom", "a/b")], [["x"] * 3], "must be a list of at most 2"),
        ("watch log", [True], [1], "must be true or false"),
        ("drive mode", ["D", "X"], ["d", "", "DX"], "must be D, X"),
    ],
)  # fmt: skip
def test_values_at_the_bounds_are_taken_and_beyond_them_refused(field, good, bad, why):
    kind, name = field.split()
    kept = [taken(kind, name, value) for value in good]
    assert kept == good and str(kept) == str(good)  # a count stays an int
    assert {taken(kind, name, value) for value in bad} == {f"{kind}: {name} {why}"}


@pytest.mark.parametrize(("modes", "fits"), [("D", (6, 12)), ("X", (8, 11)), ("DX", (8, 11))])
def test_axes_and_buttons_must_be_as_many_as_the_gamepad_has(modes, fits):
    axes, buttons = fits
    check_lengths(tuple(modes), (0,) * axes, (0,) * buttons)
    with pytest.raises(ValueError, match=r"^input: . mode has"):
        check_lengths(tuple(modes), (0,) * (axes - 2), (0,) * buttons)
