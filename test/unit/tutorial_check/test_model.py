"""The order of checks: none without its ground, none twice, one cause told once."""

import pytest

from tutorial_check.exercises import catalogue
from tutorial_check.model import (
    NOTE,
    OK,
    UNREACHED,
    WRONG,
    CannotCheck,
    Catalogue,
    Check,
    Note,
    Run,
    Wrong,
    passed,
)

CHECKS = (
    Check("A", "1", "a", "1"),
    Check("B", "1", "b", "1", ("A",)),
    Check("C", "2", "c", "2", ("B",)),
)


def wrong(seen="bad", where="f:1"):
    def check(session):
        raise Wrong("good", seen, where)

    return check


def run(**functions):
    called = []

    def counted(name, function):
        def call(session):
            called.append(name)
            return function(session)

        return call

    named = {name: functions.get(name, lambda session: None) for name in "ABC"}
    return Run(Catalogue(CHECKS, {n: counted(n, f) for n, f in named.items()}), None), called


def statuses(results):
    return [(result.id, result.status) for result in results]


def test_all_well():
    one, called = run(B=lambda session: Note("odd"))
    results = one.exercise("1")
    assert statuses(results) == [("A", OK), ("B", NOTE)]
    assert passed(results)
    one.exercise("1")
    assert called == ["A", "B"]


def test_what_stands_on_something_wrong_is_not_reached():
    one, called = run(A=wrong())
    results = one.exercise("1")
    assert statuses(results) == [("A", WRONG), ("B", UNREACHED)]
    assert called == ["A"]
    assert "A" in results[1].seen
    assert not passed(results)


def test_the_culprit_of_an_earlier_exercise_is_told_with_the_later_one():
    one, _ = run(A=wrong())
    assert statuses(one.exercise("2")) == [("A", WRONG), ("C", UNREACHED)]


def test_it_is_told_once():
    one, _ = run(A=wrong())
    one.exercise("1")
    assert statuses(one.exercise("2")) == [("C", UNREACHED)]


def test_one_cause_is_one_result():
    checks = (
        Check("A", "1", "a", "1"),
        Check("B", "1", "b", "1"),
        Check("C", "1", "c", "1", ("B",)),
    )
    called = []
    one = Run(Catalogue(checks, {"A": wrong(), "B": wrong(), "C": called.append}), None)
    assert statuses(one.exercise("1")) == [("A", WRONG), ("B", UNREACHED), ("C", UNREACHED)]
    assert not called


@pytest.mark.parametrize(
    ("expected", "where", "status"),
    [
        ("good", "", UNREACHED),
        ("another file", "", WRONG),  # "no such file" is said of two files
        ("another file", "scripts", WRONG),
        ("it drives", "scripts/a.py:3", UNREACHED),  # one line keeps two things from holding
    ],
)
def test_when_two_checks_tell_of_one_cause(expected, where, status):
    def second(session):
        raise Wrong(expected, "bad", where)

    checks = (Check("A", "1", "a", "1"), Check("B", "2", "b", "2"))
    one = Run(Catalogue(checks, {"A": wrong(where=where), "B": second}), None)
    one.exercise("1")
    assert statuses(one.exercise("2")) == [("B", status)]


@pytest.mark.parametrize(
    ("error", "why"),
    [
        (CannotCheck("the robot does not start"), "A: the robot does not start"),
        (KeyError("joy"), "A: KeyError: 'joy' (test_model.py:"),
    ],
)
def test_what_cannot_be_checked_keeps_nothing_else_from_it(error, why):
    def fails(session):
        raise error

    checks = (*CHECKS, Check("D", "2", "d", "2"))
    functions = {"A": fails, "B": print, "C": print, "D": lambda session: "well"}
    one = Run(Catalogue(checks, functions), None)
    first, second = one.exercise("1"), one.exercise("2")
    assert statuses(first) == [("A", UNREACHED), ("B", UNREACHED)]
    assert "could not be checked" in first[0].seen and first[1].seen == "A could not be checked"
    assert statuses(second) == [("C", UNREACHED), ("D", OK)]  # A is told once
    assert one.trouble("1").startswith(why)
    assert one.trouble("2") == ""
    assert not passed(first)


def test_it_can_end_at_the_first():
    one, _ = run(A=wrong())
    assert statuses(one.exercise("1", only_first=True)) == [("A", WRONG)]


def test_each_check_has_its_function():
    with pytest.raises(ValueError, match="B"):
        Catalogue(CHECKS[:2], {"A": None})


@pytest.mark.parametrize(
    ("sure", "busy", "calls"), [(False, True, 2), (True, True, 1), (False, False, 1)]
)
def test_what_is_wrong_on_a_busy_machine_is_looked_at_twice(sure, busy, calls):
    made = []

    def slow(session):
        made.append(session)
        raise Wrong("soon", "late", sure=sure)

    run = Run(
        Catalogue([Check("C1", "2", "first", "2.1")], {"C1": slow}), None, lambda explained: busy
    )
    assert run.result("C1").status == "wrong"
    assert len(made) == calls


def test_a_cause_that_was_told_is_not_looked_for_again():
    """Else the second look may tell of it in other words, as if there were two."""
    looks = iter(["f:1", "f:1", "f:1", "f"])

    def second(session):
        raise Wrong("good", "bad", next(looks))

    checks = (Check("A", "1", "a", "1"), Check("B", "1", "b", "1"))
    one = Run(Catalogue(checks, {"A": second, "B": second}), None, lambda explained: True)
    assert statuses(one.exercise("1")) == [("A", WRONG), ("B", UNREACHED)]


def test_on_a_machine_far_too_busy_there_is_no_verdict():
    catalogue = Catalogue([Check("C1", "2", "first", "2.1")], {"C1": wrong()})
    one = Run(catalogue, None, lambda explained: True, lambda: True)
    assert one.result("C1").status == UNREACHED
    assert "the machine has too much else to do" in one.trouble("2")


def test_no_machine_is_too_busy_for_what_is_read():
    check = Check("C1", "2", "first", "2.1", timeless=True)
    one = Run(Catalogue([check], {"C1": wrong()}), None, lambda explained: True, lambda: True)
    assert one.result("C1").status == WRONG
    assert {"C5", "C13", "C21", "C29"} <= {
        each.id for each in catalogue().checks.values() if each.timeless
    }


def test_the_second_look_counts():
    looks = iter([Wrong("soon", "late"), None])

    def late_once(session):
        if error := next(looks):
            raise error

    run = Run(
        Catalogue([Check("C1", "2", "first", "2.1")], {"C1": late_once}),
        None,
        lambda explained: True,
    )
    assert run.result("C1").status == "ok"


@pytest.mark.parametrize(
    ("where", "explained"), [("scripts/a.py:3", True), ("scripts/a.py", False)]
)
def test_what_a_line_explains_is_told_apart(where, explained):
    asked = []
    catalogue = Catalogue([Check("C1", "2", "first", "2.1")], {"C1": wrong(where=where)})
    Run(catalogue, None, asked.append).result("C1")
    assert asked == [explained]
