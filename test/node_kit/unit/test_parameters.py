"""Each mistake in a parameter is one line: the parameter, its value and what is allowed."""

from dataclasses import MISSING, dataclass
from math import inf, nan
from typing import Dict

import pytest

from node_kit.parameters import declaration
from node_kit.parameters.declaration import number, parameter, switch, text, whole_number
from tutorial_testing.claims import claim

pytestmark = claim(
    "Every mistake in a parameter is one line that says what is allowed; one that an earlier "
    "launch left has the command that deletes it"
)


@dataclass(frozen=True)
class Parameters:
    """One parameter or more of each kind."""

    rate: float = parameter(50.0, number(5, 1000, "Hz"), "messages published", "as it comes")
    share: float = parameter(0.5, number(0, 1))
    count: int = parameter(3, whole_number(1, 9, "a whole number from 1 to 9"))
    seed: int = parameter(0, whole_number())
    works: bool = parameter(True, switch)
    frame: str = parameter("odom", text("a name without blanks", lambda value: " " not in value))
    robots: Dict[str, float] = parameter({}, lambda value: value)
    derived: float = 1.0  # not a parameter


@dataclass(frozen=True)
class Entry:
    """One required parameter."""

    topic: str = parameter(MISSING, text())


def message_of(given, kind=Parameters, **more):
    with pytest.raises(ValueError) as caught:
        declaration.checked(kind, given, **more)
    return str(caught.value)


@pytest.mark.parametrize(("name", "good", "bad", "allowed"), [
    ("rate", [5, 1000, 5.0, 30],
     [4.9, 1000.1, nan, inf, -inf, "50", True, None, [50.0], 10**400],
     "a number from 5 to 1000 Hz"),
    ("share", [0, 1], [2, -0.1], "a number from 0 to 1"),
    ("count", [1, 2, 9], [0, 10, 2.0, True, "3", None], "a whole number from 1 to 9"),
    ("seed", [-(10**9), 10**9], [1.5], "a whole number"),
    ("works", [True, False], [0, 1, "true", None], "true or false"),
    ("frame", ["odom", ""], ["a b", 7, None], "a name without blanks"),
])  # fmt: skip
def test_what_is_allowed(name, good, bad, allowed):
    for value in good:
        kept = declaration.checked(Parameters, {name: value})[name]
        assert kept == value
        assert isinstance(kept, type(getattr(Parameters(), name)))
    for value in bad:
        assert message_of({name: value}) == f"~{name}: {value!r}: must be {allowed}"


def test_a_number_is_finite_and_fits_in_a_float():
    assert [declaration.is_number(value) for value in (1.7e308, -1, 0, 10**308)] == [True] * 4
    bad = [nan, inf, -inf, 10**309, -(10**309), True, "1", None]
    assert [declaration.is_number(value) for value in bad] == [False] * len(bad)


TABLE = """\
| parameter | default | allowed | |
|---|---|---|---|
| `~rate` | as it comes | a number from 5 to 1000 Hz | messages published |
| `~share` | 0.5 | a number from 0 to 1 |  |
| `~count` | 3 | a whole number from 1 to 9 |  |
| `~seed` | 0 | a whole number |  |
| `~works` | true | true or false |  |
| `~frame` | odom | a name without blanks |  |
| `~robots` | {} |  |  |
"""


def test_the_table_in_a_readme():
    assert declaration.table(Parameters) == TABLE
    assert declaration.table(Entry, where="").endswith("\n| `topic` |  | a text |  |\n")


def test_each_set_of_defaults_has_a_map_of_its_own():
    values = declaration.checked(Parameters, {})
    assert Parameters(**values) == Parameters()
    values["robots"]["ada"] = 1.0
    assert declaration.checked(Parameters, {})["robots"] == {}


def test_a_missing_one_and_where_it_is():
    line = message_of({}, Entry, where="entry 2: ", example="as in topic: a")
    assert line == "entry 2: topic: missing; as in topic: a"
    line = "entry 2: topci: 1: no such parameter; did you mean topic?"
    assert message_of({"topci": 1}, Entry, where="entry 2: ") == line
    assert declaration.unknown("topci", 1, ["topic"], where="~entry 2: ") == f"~{line}"
    assert declaration.checked(Entry, {"topic": "/odom"}) == {"topic": "/odom"}
