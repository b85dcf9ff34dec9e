"""What pages may say."""

import json
import random

import pytest

from cockpit_server.schema import LONGEST_MESSAGE, MESSAGES, check_lengths, check_message

GOOD = {
    "watch": {
        "robots": True, "look": None, "graph": False, "topic": "/odom", "node": None,
        "fields": ["/odom/pose/pose/position/x"], "field_list": False, "log": True, "bag": False,
    },
    "drive": {"robot": "", "mode": "D"},
    "leave": {},
    "hand_over": {"to": 3},
    "input": {
        "n": 1, "t": 12.5, "beat": 0, "axes": [0, 1, -1.0, 0, 0, 0], "buttons": [0] * 12,
        "pad": None, "source": "keys",
    },
    "release": {"why": "hidden"},
    "reset": {"robot": "robot_1"},
    "bag_open": {"name": "joy.bag"},
    "bag_play": {"topic": "/joy", "rate": 1, "loop": False, "robot": ""},
    "bag_pause": {},
    "bag_seek": {"position": 3.5},
    "doctor": {},
}  # fmt: skip
WRONG = (None, True, -1, 1.5, 2**60, 1e300, "x" * 300, "a\nb", [], {}, [[]], [None] * 21)


def say(kind, **fields):
    return json.dumps({"kind": kind, **fields})


def test_every_kind_has_an_example():
    assert set(GOOD) == set(MESSAGES)


@pytest.mark.parametrize("kind", MESSAGES)
def test_what_is_good_is_taken(kind):
    assert check_message(say(kind, **GOOD[kind]))[0] == kind


@pytest.mark.parametrize("kind", MESSAGES)
def test_a_missing_or_unknown_field_is_refused(kind):
    for name in GOOD[kind]:
        less = {field: value for field, value in GOOD[kind].items() if field != name}
        with pytest.raises(ValueError, match=f"{kind} lacks {name}"):
            check_message(say(kind, **less))
    with pytest.raises(ValueError, match="has no field 'more'"):
        check_message(say(kind, **GOOD[kind], more=1))


@pytest.mark.parametrize("kind", MESSAGES)
def test_each_field_has_bounds(kind):
    for name in GOOD[kind]:
        refused = 0
        for value in WRONG:
            try:
                check_message(say(kind, **{**GOOD[kind], name: value}))
            except ValueError as error:
                assert len(str(error)) < 200 and "\n" not in str(error)
                refused += 1
        assert refused >= len(WRONG) / 2, name


@pytest.mark.parametrize(
    "axes",
    [[1.01], [-2], ["0"], [True], [None], [0] * 9, [float("nan")], [float("inf")], 1, "0"],
)
def test_axes_are_few_numbers_from_minus_one_to_one(axes):
    with pytest.raises(ValueError, match="axes"):
        check_message(say("input", **{**GOOD["input"], "axes": axes}))


@pytest.mark.parametrize("buttons", [[2], [-1], [True], [0.5], [0] * 13, "1"])
def test_buttons_are_few_zeros_and_ones(buttons):
    with pytest.raises(ValueError, match="buttons"):
        check_message(say("input", **{**GOOD["input"], "buttons": buttons}))


@pytest.mark.parametrize(
    "data",
    [
        b"{}", "", "null", "[]", "{", "1", '{"kind": 1}', '{"kind": "publish"}', "[" * 5000,
        '{"kind": "leave"' + " " * LONGEST_MESSAGE + "}", '{"kind": ["leave"]}', '"leave"',
    ],
)  # fmt: skip
def test_what_is_no_message_is_refused(data):
    with pytest.raises(ValueError, match="message"):
        check_message(data)


def taken(kind, name, value):
    """What is kept of a field's value; None if it is refused."""
    try:
        return check_message(say(kind, **{**GOOD[kind], name: value}))[1][name]
    except ValueError:
        return None


# The last values on both sides that are taken, and the first ones that are not.
@pytest.mark.parametrize(
    ("kind", "name", "good", "bad"),
    [
        ("input", "n", [0, 2**53 - 1], [-1, 2**53]),
        ("input", "t", [0, 1e15], [-0.001, 1e15 + 1]),
        ("input", "pad", [0, 1e15], [-0.001, 1e15 + 1]),
        ("bag_play", "rate", [0.1, 10], [0.099, 10.01]),
        ("bag_seek", "position", [0, 1e6], [-0.001, 1000000.1]),
        ("release", "why", ["", "x" * 200], ["x" * 201]),
        ("watch", "topic", [None, "/", "/odom", "/" + "x" * 199], ["", "odom", "/" + "x" * 200]),
        ("watch", "node", [None, "/", "/sim", "/" + "x" * 199], ["", "sim/", "/" + "x" * 200]),
        ("drive", "mode", ["D", "X"], ["d", "", "DX"]),
        ("input", "source", ["pad", "touch", "keys"], ["mouse"]),
    ],
)
def test_the_bounds_are_taken_and_nothing_beyond_them(kind, name, good, bad):
    assert [taken(kind, name, value) for value in good] == good
    assert [taken(kind, name, value) for value in bad] == [None] * len(bad)


@pytest.mark.parametrize("name", ["t", "pad", "axes"])
def test_a_number_of_four_hundred_digits_is_refused_like_any_other(name):
    value = [10**400] if name == "axes" else 10**400
    with pytest.raises(ValueError, match=f"input: {name} must be a number from"):
        check_message(say("input", **{**GOOD["input"], name: value}))


@pytest.mark.parametrize(
    ("kind", "name", "one", "most"),
    [
        ("watch", "fields", "/a/x", 20),
        ("input", "axes", -1, 8),
        ("input", "axes", 1, 8),
        ("input", "buttons", 0, 12),
        ("input", "buttons", 1, 12),
    ],
)
def test_lists_of_at_most_so_many(kind, name, one, most):
    assert taken(kind, name, []) == ()
    assert taken(kind, name, [one] * most) == (one,) * most
    assert taken(kind, name, [one] * (most + 1)) is None


def test_numbers_become_float_and_counts_stay_whole():
    _, values = check_message(say("input", **GOOD["input"]))
    assert values == {**GOOD["input"], "axes": (0, 1, -1, 0, 0, 0), "buttons": (0,) * 12}
    assert [type(values[name]) for name in ("n", "t", "beat")] == [int, float, int]
    assert {type(axis) for axis in values["axes"]} == {float}


@pytest.mark.parametrize(
    ("kind", "name", "value", "words"),
    [
        ("input", "n", -1, "must be a whole number from 0"),
        ("input", "axes", [2], "must be a number from -1 to 1"),
        ("input", "axes", [0] * 9, "must be a list of at most 8"),
        ("input", "buttons", [2], "must be 0 or 1"),
        ("input", "source", "mouse", "must be pad, touch, keys"),
        ("release", "why", None, "must be a text of at most 200 characters"),
        ("watch", "log", 1, "must be true or false"),
        ("watch", "topic", "odom", "must begin with /"),
        ("watch", "topic", 1, "must be a text of at most 200 characters"),
    ],
)
def test_what_a_page_is_told(kind, name, value, words):
    with pytest.raises(ValueError) as caught:
        check_message(say(kind, **{**GOOD[kind], name: value}))
    assert str(caught.value) == f"{kind}: {name} {words}"


def test_the_longest_message():
    message = say("leave")
    longest = message + " " * (8192 - len(message))
    assert check_message(longest) == ("leave", {})
    with pytest.raises(ValueError, match="a message must have at most 8192 characters"):
        check_message(longest + " ")


def test_forty_characters_of_a_strange_word_are_told():
    with pytest.raises(ValueError) as caught:
        check_message(say("x" * 41))
    assert str(caught.value) == f"no such kind of message: '{'x' * 40}'"


def test_random_changes_are_taken_or_refused_and_nothing_else():
    dice = random.Random(1)
    for _ in range(3000):
        kind = dice.choice(list(GOOD))
        letters = list(say(kind, **GOOD[kind]))
        for _ in range(dice.randrange(1, 4)):
            letters[dice.randrange(len(letters))] = dice.choice('{}[]":,0e-x\\')
        try:
            check_message("".join(letters))
        except ValueError as error:
            assert len(str(error)) < 300


def test_as_many_axes_and_buttons_as_the_gamepad_has():
    check_lengths(("D",), (0,) * 6, (0,) * 12)
    check_lengths(("X",), (0,) * 8, (0,) * 11)
    for mode, axes, buttons in (("D", 8, 11), ("X", 6, 12), ("D", 0, 0), ("D", 6, 11)):
        with pytest.raises(ValueError, match=f"{mode} mode has"):
            check_lengths((mode,), (0,) * axes, (0,) * buttons)
    with pytest.raises(ValueError) as caught:
        check_lengths(("D", "X"), (0,) * 6, (0,) * 11)
    has = "D mode has 6 axes and 12 buttons and X mode has 8 axes and 11 buttons"
    assert str(caught.value) == f"input: {has}"
    check_lengths(("D", "X"), (0,) * 8, (0,) * 11)
