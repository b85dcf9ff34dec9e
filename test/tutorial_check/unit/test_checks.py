"""The order of checks: each after those it needs, none twice, each cause reported once."""

from dataclasses import replace

import pytest

from tutorial_check.checking.checks import Check, CheckRunner, checks_of
from tutorial_check.checking.results import OK, UNREACHED, WRONG, Note, Outcome, Wrong
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck
from tutorial_testing.claims import claim

pytestmark = claim(
    "A check is made after those it needs, one cause is reported once, and a check that cannot "
    "work keeps no other from it"
)
NEEDS = {"A": ("1", ()), "B": ("1", ("A",)), "C": ("2", ("B",)), "D": ("2", ())}
CHECKS = [Check(name, n, name, n, print, needs) for name, (n, needs) in NEEDS.items()]
ONE, OTHER = Check("A", "1", "a", "1", print), Check("B", "2", "b", "2", print)
BAD = Wrong("good", "bad", "f:1")


class Machine:
    """A submission's report on its machine; it counts how often recordings are forgotten."""

    def __init__(self, busy, overloaded):
        self.busy, self.overloaded = (lambda: busy), (lambda: overloaded)
        self.forgotten = 0

    def forget_recordings(self):
        self.forgotten += 1


def run(checks, busy=False, overloaded=False, **come_to):
    """Return (CheckRunner, ids of checks it has called); come_to: results, or iterators of them."""
    called = []

    def function(name):
        def call(submission):
            called.append(name)
            result = come_to.get(name)
            result = result if isinstance(result, (Exception, Note, type(None))) else next(result)
            if isinstance(result, Exception):
                raise result
            return result

        return call

    checks = [replace(check, function=function(check.id)) for check in checks]
    return CheckRunner(checks, Machine(busy, overloaded)), called


def statuses(runner, exercises, **options):
    results = [result for name in exercises.split() for result in runner.exercise(name, **options)]
    return " ".join(f"{result.id}:{result.status}" for result in results)


@pytest.mark.parametrize(("come_to", "exercises", "expected", "calls"), [
    ({"B": Note("odd")}, "1 1", "A:ok B:note A:ok B:note", "A B"),
    ({"A": BAD}, "1 2", "A:wrong B:unreached C:unreached D:ok", "A D"),
    ({"A": BAD}, "2", "A:wrong C:unreached D:ok", "A D"),  # B, reported with the later exercise
])  # fmt: skip
def test_checks_come_after_those_they_need(come_to, exercises, expected, calls):
    runner, called = run(CHECKS, **come_to)
    assert statuses(runner, exercises) == expected
    assert called == calls.split()
    outcome = Outcome("1", list(runner.exercise("1")), done=True)
    assert outcome.passed == (BAD not in come_to.values())
    if BAD in come_to.values():
        assert statuses(run(CHECKS, **come_to)[0], "1", only_first=True) == "A:wrong"


@pytest.mark.parametrize(("expected", "where", "status"), [
    ("good", "", UNREACHED),
    ("another file", "", WRONG),  # "no such file" is said of two files
    ("another file", "scripts", WRONG),
    ("it drives", "scripts/a.py:3", UNREACHED),  # one line breaks two checks
])  # fmt: skip
def test_when_two_checks_are_about_one_cause(expected, where, status):
    first, second = Wrong("good", "bad", where), Wrong(expected, "bad", where)
    assert statuses(run([ONE, OTHER], A=first, B=second)[0], "1 2") == f"A:wrong B:{status}"


def test_a_cause_that_was_reported_is_not_looked_for_again():
    """Otherwise a retry might report it again in other words."""
    second = (Wrong("good", "bad", where) for where in ("f:1", "f"))
    runner, called = run([ONE, OTHER], True, A=iter([BAD, BAD]), B=second)
    assert statuses(runner, "1 2") == "A:wrong B:unreached"
    assert called == ["A", "A", "B"]


@pytest.mark.parametrize(("error", "why"), [
    (CannotCheck("the robot does not start"), "A: the robot does not start"),
    (KeyError("joy"), "A: KeyError: 'joy' (test_checks.py:"),
])  # fmt: skip
def test_what_cannot_be_checked_keeps_no_other_check_from_it(error, why):
    runner, _ = run(CHECKS, A=error)
    assert statuses(runner, "1 2") == "A:unreached B:unreached C:unreached D:ok"
    assert "could not be checked" in runner.result("A").seen
    assert runner.result("B").seen == "A could not be checked"
    assert runner.trouble("1").startswith(why) and runner.trouble("2") == ""


@claim(
    "A check that does not hold is made again if the machine was busy or no line is to blame; with "
    "too little time there is no verdict"
)
@pytest.mark.parametrize(("about", "busy", "overloaded", "looks", "status"), [
    ("", False, False, 1, WRONG),
    ("no line", False, False, 2, WRONG),
    ("", True, False, 2, WRONG),
    ("sure", True, True, 1, WRONG),
    ("timeless", True, True, 1, WRONG),  # it only reads files
    ("", True, True, 2, UNREACHED),
    ("late once", True, False, 2, OK),
])  # fmt: skip
def test_a_retry_on_a_busy_machine_or_without_a_line(about, busy, overloaded, looks, status):
    wrong = Wrong("good", "bad", "f" if about == "no line" else "f:1", sure=about == "sure")
    check = replace(ONE, timeless=about == "timeless")
    come_to = iter([wrong, None if about == "late once" else wrong])
    runner, called = run([check], busy, overloaded, A=come_to)
    assert runner.result("A").status == status
    assert (len(called), runner._submission.forgotten) == (looks, looks - 1)
    assert ("the machine is too busy" in runner.trouble("1")) == (status == UNREACHED)
    checks = checks_of(read_course())
    assert {"C5", "C13", "C21", "C29"} <= {check.id for check in checks if check.timeless}
