"""Variants of the task: a right solution of each is right, that of another is wrong; no answer is given."""

import random
import re

import pytest
from another_task import can_be_turned, texts, turn
from edits import apply
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from test_mistakes import OF_HANDOUT, named

from tutorial_check.course import read_course
from tutorial_check.examination import examine
from tutorial_check.report import lines_of
from tutorial_check.variants import drawn

COURSE = read_course()
HYPOTHESIS = {
    "max_examples": 60,
    "derandomize": True,
    "database": None,
    "phases": [Phase.generate],
    "suppress_health_check": list(HealthCheck),
}
TOPICS = {"joy", "cmd_vel"}  # a launch file with a mistake is not turned to others
AXES = {key for key in COURSE.variants if key.startswith(("axis", "scale", "enable"))}


def task(number, leave_out=()):
    values = drawn(COURSE, "test", str(number))
    return {key: value for key, value in values.items() if key not in leave_out}


def results(src, exercises, values):
    outcomes = examine(src.parent, UNDERLAY["is"], exercises, variant=values)
    assert not [one.trouble for one in outcomes if one.trouble]
    return [one for each in outcomes for one in each.results]


UNDERLAY = {}


@pytest.fixture(autouse=True)
def _underlay(underlay):
    UNDERLAY["is"] = underlay


def given_away(result, values, own):
    """The values of a task that a result without its hint names, and the student's files do not."""
    words = "\n".join((result.title, result.expected, result.seen, result.where, result.look))
    tokens = {
        **{key: rf"axes\[{values[key]}\]|axis {values[key]}\b" for key in values if "axis_" in key},
        **{key: rf"{values[key]}(?!\w)" for key in TOPICS & set(values)},
        **{key: rf"\b{values[key]}\b" for key in ("package", "node") if key in values},
        "enable_button": rf"buttons\[{values.get('enable_button')}\]",
    }
    numbers = ("scale_linear", "scale_angular", "rate")
    found = [key for key, token in tokens.items() if _is_new(token, words, own)]
    return found + [key for key in numbers if re.search(rf"\b{values.get(key)}\b", result.expected)]


def _is_new(token, words, own):
    return any(found[0] not in own for found in re.finditer(token, words))


def must_give_nothing_away(found, values, src):
    own = "\n".join(texts(src)) + "\n".join(str(path) for path in src.rglob("*"))
    for one in found:
        assert not given_away(one, values, own), "\n".join(lines_of(one))


def forty():
    """Variants from all that is allowed, the extremes among them; the same each time."""
    found = []
    words = {
        key: st.from_regex(COURSE.variants[key].allowed, fullmatch=True).filter(
            lambda word: 3 < len(word) < 20
        )
        for key in ("joy", "cmd_vel", "package", "node")
    }
    scales = {
        key: st.integers(20, int(100 * COURSE.variants[key].allowed[1])).map(lambda n: n / 100)
        for key in ("scale_linear", "scale_angular")
    }
    numbers = {"enable_button": st.integers(0, 10), "rate": st.integers(2, 50)}
    axes = st.none() | st.permutations(range(6)).map(lambda order: order[:2])

    @settings(**HYPOTHESIS)
    @given(st.fixed_dictionaries({}, optional={**words, **scales, **numbers}), axes)
    def collect(values, both):
        named = {"axis_linear": both[0], "axis_angular": both[1]} if both else {}
        assume(values.get("joy") != values.get("cmd_vel") or "joy" not in values)
        task = {**named, **values}
        assume(len(task) > 3 and task not in found)
        found.append(task)

    collect()
    return found[:40]


@pytest.mark.parametrize("values", forty(), ids=str)
def test_a_right_solution_of_a_task(values, literal):
    turn(literal, values)
    exercises = COURSE.by_default if len(values) > 7 else ["3", "4.3", "6.2"]
    found = results(literal, exercises, values)
    assert not [lines_of(one) for one in found if one.status in ("wrong", "unreached")]
    must_give_nothing_away(found, values, literal)


@pytest.mark.parametrize("number", range(3))
def test_a_right_solution_of_another_task(number, literal):
    """Package, topics and node are the same, as of a neighbour; axes and factors are not."""
    values = task(number)
    turn(literal, {**values, **task(number + 40, leave_out={"package", "joy", "cmd_vel", "node"})})
    found = results(literal, ["4.3"], values)
    wrong = [one for one in found if one.status == "wrong"]
    assert [one.id for one in wrong][:1] == ["C16"], found
    must_give_nothing_away(found, values, literal)


@pytest.mark.parametrize(
    ("key", "check"),
    [
        ("joy", "C14"),
        ("cmd_vel", "C15"),
        ("package", "C12"),
        ("node", "C15"),
        ("rate", "C6"),
        ("scale_linear", "C16"),
        ("scale_angular", "C16"),
        ("axis_linear", "C16"),
        ("enable_button", "C16"),
    ],
)
def test_each_value_is_checked(key, check, literal):
    """All is right but for one value, that of the handout."""
    values = task(1)
    turn(literal, {name: value for name, value in values.items() if name != key})
    found = results(literal, ["3" if key == "rate" else "4.3"], values)
    assert [one.id for one in found if one.status == "wrong"][:1] == [check]
    must_give_nothing_away(found, values, literal)


@pytest.mark.parametrize("turn_of", range(3))
@pytest.mark.parametrize("row", OF_HANDOUT, ids=named(OF_HANDOUT))
def test_mistake_in_a_task(row, turn_of, literal):
    """Found at the same check as in the handout's task, with the same words but for the values."""
    exercise, what, edits, check, _ = row
    apply(edits, literal)
    number = random.Random(f"{what}{turn_of}").randrange(1000)
    left_out = set() if exercise in ("3", "4.3", "6.2") else TOPICS
    left_out |= set() if can_be_turned(literal) else AXES
    values = task(number, left_out)
    turn(literal, values)
    found = results(literal, [exercise], values)
    wrong = [one for one in found if one.status == "wrong"]
    assert wrong, values
    assert wrong[0].id == check, (values, lines_of(wrong[0]))
    must_give_nothing_away(found, values, literal)
