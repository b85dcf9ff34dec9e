"""Parameters: one line for every mistake, which names the parameter, its value, what is allowed."""

import sys
from dataclasses import MISSING, dataclass
from math import inf, nan
from typing import Dict

import pytest

from node_kit.parameters import (
    checked,
    is_number,
    number,
    parameter,
    switch,
    text,
    unknown,
    whole_number,
)


@dataclass(frozen=True)
class Parameters:
    """Some of each kind."""

    rate: float = parameter(50.0, number(5, 1000, "Hz"))
    share: float = parameter(0.5, number(0, 1))
    count: int = parameter(3, whole_number(1, 9, "a whole number from 1 to 9"))
    seed: int = parameter(0, whole_number())
    works: bool = parameter(True, switch)
    frame: str = parameter("odom", text("a name without blanks", lambda value: " " not in value))
    robots: Dict[str, float] = parameter({}, lambda value: value)  # noqa: RUF009
    derived: float = 1.0  # not to be given


@dataclass(frozen=True)
class Entry:
    """One that must be given."""

    topic: str = parameter(MISSING, text())


def message_of(given, kind=Parameters, **more):
    with pytest.raises(ValueError) as caught:
        checked(kind, given, **more)
    return str(caught.value)


def test_nothing_given_is_the_defaults():
    values = checked(Parameters, {})
    assert values == {
        "rate": 50.0, "share": 0.5, "count": 3, "seed": 0, "works": True, "frame": "odom",
        "robots": {},
    }  # fmt: skip
    assert Parameters(**values).derived == 1.0


def test_a_map_that_is_a_default_is_nobody_elses():
    checked(Parameters, {})["robots"]["ada"] = 1.0
    assert checked(Parameters, {})["robots"] == {}


def test_a_whole_number_passes_for_a_number_and_becomes_one():
    assert checked(Parameters, {"rate": 30})["rate"] == 30.0
    assert isinstance(checked(Parameters, {"rate": 30})["rate"], float)


@pytest.mark.parametrize("value", [5, 1000, 5.0])
def test_the_bounds_are_allowed(value):
    assert checked(Parameters, {"rate": value})["rate"] == value


@pytest.mark.parametrize("value", [4.9, 1000.1, nan, inf, -inf, "50", True, None, [50.0]])
def test_no_number_within_the_bounds(value):
    allowed = "a number from 5 to 1000 Hz"
    assert message_of({"rate": value}) == f"~rate: {value!r}: must be {allowed}"


def test_a_whole_number_that_is_too_large_for_a_float_is_no_number():
    largest = sys.float_info.max
    assert all(map(is_number, (largest, -largest, int(largest), -int(largest))))
    for value in (10**400, -(10**400)):
        assert not is_number(value)
        line = f"~rate: {value}: must be a number from 5 to 1000 Hz"
        assert message_of({"rate": value}) == line


def test_a_number_without_a_unit():
    assert message_of({"share": 2}) == "~share: 2: must be a number from 0 to 1"


@pytest.mark.parametrize("value", [0, 10, 2.0, True, "3", None])
def test_no_whole_number_within_the_bounds(value):
    allowed = "a whole number from 1 to 9"
    assert message_of({"count": value}) == f"~count: {value!r}: must be {allowed}"


@pytest.mark.parametrize("value", [1, 2, 9])
def test_the_bounds_of_a_whole_number_are_allowed(value):
    assert checked(Parameters, {"count": value})["count"] == value


def test_one_bound_of_a_whole_number_is_enough():
    least, most = whole_number(least=2, allowed="2 or more"), whole_number(most=2)
    assert (least(2), least(99), most(2), most(-99)) == (2, 99, 2, -99)
    for check, value in ((least, 1), (most, 3), (least, "3"), (most, 1.0)):
        with pytest.raises(ValueError, match=r"must be (2 or more|a whole number)"):
            check(value)


def test_a_whole_number_without_bounds():
    assert checked(Parameters, {"seed": -(10**9)})["seed"] == -(10**9)
    assert message_of({"seed": 1.5}) == "~seed: 1.5: must be a whole number"


@pytest.mark.parametrize("value", [0, 1, "true", None])
def test_no_switch(value):
    assert message_of({"works": value}) == f"~works: {value!r}: must be true or false"


@pytest.mark.parametrize("value", ["a b", 7, None])
def test_no_fitting_text(value):
    assert message_of({"frame": value}) == f"~frame: {value!r}: must be a name without blanks"


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("rat", "did you mean ~rate?"),
        ("frames", "did you mean ~frame?"),
        ("axis_liner", "did you mean ~axis_linear?"),
        ("colour", "allowed: axis_linear, count, frame, rate, robots, seed, share, works"),
        ("derived", "allowed: axis_linear, count, frame, rate, robots, seed, share, works"),
    ],
)
def test_an_unknown_name(name, hint):
    line = f"~{name}: 5: no such parameter; {hint}"
    assert message_of({name: 5}, others=["axis_linear"]) == line


def test_one_checked_elsewhere_is_left_out():
    assert "axis_linear" not in checked(Parameters, {"axis_linear": 1}, others=["axis_linear"])


def test_a_missing_one_and_where_it_is():
    line = message_of({}, Entry, where="entry 2: ", example="as in topic: a")
    assert line == "entry 2: topic: missing; as in topic: a"
    line = message_of({"topci": 1}, Entry, where="entry 2: ")
    assert line == "entry 2: topci: 1: no such parameter; did you mean topic?"
    assert checked(Entry, {"topic": "/odom"}) == {"topic": "/odom"}


def test_only_what_stands_after_the_bare_sign_of_the_node_is_named_with_it():
    line = "~entry 2: topci: 1: no such parameter; did you mean topic?"
    assert unknown("topci", 1, ["topic"], where="~entry 2: ") == line
