"""The order of checks: none without those it needs, none twice, one cause reported once."""

from dataclasses import replace

import pytest

from tutorial_check.exercises import all_checks
from tutorial_check.model import (
    NOTE,
    OK,
    UNREACHED,
    WRONG,
    CannotCheck,
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


def raises(error):
    def check(session):
        raise error

    return check


def wrong(seen="bad", where="f:1", expected="good", **more):
    return raises(Wrong(expected, seen, where, **more))


def run(checks=CHECKS, busy=None, hopeless=False, **functions):
    """(Run, ids of the checks that it has called); busy: its answer to whether to look again."""
    called = []

    def counted(name):
        function = functions.get(name, lambda session: None)
        return lambda session: [called.append(name), function(session)][1]

    checks = [replace(check, function=counted(check.id)) for check in checks]
    return Run(checks, None, lambda explained: bool(busy), lambda: hopeless), called


def statuses(results):
    return "; ".join(f"{result.id} {result.status}" for result in results)


def independent(*exercises, **options):
    return tuple(Check(name, one, name, one, **options) for name, one in zip("ABCD", exercises))


def test_all_well():
    one, called = run(B=lambda session: Note("odd"))
    results = one.exercise("1")
    assert statuses(results) == f"A {OK}; B {NOTE}" and passed(results)
    one.exercise("1")
    assert called == ["A", "B"]


def test_what_needs_something_wrong_is_not_reached():
    one, called = run(A=wrong())
    results = one.exercise("1")
    assert statuses(results) == f"A {WRONG}; B {UNREACHED}" and not passed(results)
    assert called == ["A"] and "A" in results[1].seen
    assert statuses(one.exercise("2")) == f"C {UNREACHED}"  # A was reported


def test_the_culprit_of_an_earlier_exercise_is_reported_with_the_later_one():
    assert statuses(run(A=wrong())[0].exercise("2")) == f"A {WRONG}; C {UNREACHED}"


def test_it_can_end_at_the_first():
    assert statuses(run(A=wrong())[0].exercise("1", only_first=True)) == f"A {WRONG}"


@pytest.mark.parametrize(
    ("expected", "where", "status"),
    [
        ("good", "", UNREACHED),
        ("another file", "", WRONG),  # "no such file" is said of two files
        ("another file", "scripts", WRONG),
        ("it drives", "scripts/a.py:3", UNREACHED),  # one line keeps two things from holding
    ],
)
def test_when_two_checks_are_about_one_cause(expected, where, status):
    second = wrong("bad", where, expected)
    one, _ = run(independent("1", "2"), A=wrong("bad", where), B=second)
    one.exercise("1")
    assert statuses(one.exercise("2")) == f"B {status}"


@pytest.mark.parametrize(
    ("error", "why"),
    [
        (CannotCheck("the robot does not start"), "A: the robot does not start"),
        (KeyError("joy"), "A: KeyError: 'joy' (test_model.py:"),
    ],
)
def test_what_cannot_be_checked_keeps_no_other_check_from_it(error, why):
    one, _ = run((*CHECKS, Check("D", "2", "d", "2")), A=raises(error))
    first, second = one.exercise("1"), one.exercise("2")
    assert statuses(first) == f"A {UNREACHED}; B {UNREACHED}" and not passed(first)
    assert "could not be checked" in first[0].seen and first[1].seen == "A could not be checked"
    assert statuses(second) == f"C {UNREACHED}; D {OK}"  # A is reported once
    assert one.trouble("1").startswith(why) and one.trouble("2") == ""


@pytest.mark.parametrize(
    ("about", "busy", "hopeless", "looks", "status"),
    [
        ("", False, False, 1, WRONG),
        ("", True, False, 2, WRONG),
        ("sure", True, True, 1, WRONG),
        ("timeless", True, True, 1, WRONG),  # it reads files alone
        ("", True, True, 2, UNREACHED),
    ],
)
def test_a_second_look_on_a_busy_machine(about, busy, hopeless, looks, status):
    checks = independent("1", timeless=about == "timeless")
    one, called = run(checks, busy, hopeless, A=wrong(sure=about == "sure"))
    assert one.result("A").status == status
    assert len(called) == looks
    assert ("the machine has too much else to do" in one.trouble("1")) == (status == UNREACHED)
    assert {"C5", "C13", "C21", "C29"} <= {each.id for each in all_checks() if each.timeless}


def test_the_second_look_counts():
    looks = iter([Wrong("soon", "late"), None])

    def late_once(session):
        if error := next(looks):
            raise error

    one, _ = run(independent("1"), True, A=late_once)
    assert one.result("A").status == OK


def test_a_cause_that_was_reported_is_not_looked_for_again():
    """Else the second look may put it in other words, as if there were two."""
    looks = iter(["f:1", "f:1", "f:1", "f"])

    def second(session):
        raise Wrong("good", "bad", next(looks))

    one, _ = run(independent("1", "1"), True, A=second, B=second)
    assert statuses(one.exercise("1")) == f"A {WRONG}; B {UNREACHED}"


@pytest.mark.parametrize(
    ("where", "explained"), [("scripts/a.py:3", True), ("scripts/a.py", False)]
)
def test_a_second_look_knows_whether_a_line_explains_it(where, explained):
    asked = []
    Run(independent("1", function=wrong(where=where)), None, asked.append).result("A")
    assert asked == [explained]
