"""Checks: the decorator that registers them, and the order in which they run."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, replace
from typing import Callable, Iterable, Iterator, TypeVar, Union, cast

from tutorial_check.checking.results import (
    NOTE,
    OK,
    UNREACHED,
    WRONG,
    Note,
    Result,
    Wrong,
    wrong_of,
)
from tutorial_check.checking.submission import Submission
from tutorial_check.course.definition import FILE, Course, load
from tutorial_check.errors import CannotCheck, CutShort, FileTooLarge, fault

LINE = re.compile(r":\d+$")  # line number at the end of a place
Verdict = Union[str, Note, None]
CheckFunction = Callable[[Submission], Verdict]
Need = Union[Callable[..., object], str]  # a check, or its id if it is in another section
_Function = TypeVar("_Function", bound=Callable[..., object])
_checks: list[Check] = []  # of all loaded courses


@dataclass(frozen=True)
class Check:
    """One line of the report."""

    id: str
    exercise: str
    title: str
    section: str  # in the course: "handout 4.3"
    function: CheckFunction
    needs: tuple[str, ...] = ()  # ids of the checks without which this one is meaningless
    look: str = ""
    timeless: bool = False  # it only reads files, so a busy machine does not matter
    eager: bool = False  # its hint is about the set-up, and is shown at once

    def result(self, status: str, verdict: Wrong | Verdict) -> Result:
        """Return a Result. verdict: what was seen, or a Wrong or Note."""
        if not isinstance(verdict, (Wrong, Note)):
            verdict = Note(verdict or "")
        about = self.title, "", verdict.seen, verdict.where, verdict.hint, self.section, self.look
        result = Result(self.id, status, *about, eager=self.eager)
        if isinstance(verdict, Note):
            return replace(result, empty=verdict.empty)
        return replace(result, expected=verdict.expected, look=verdict.look or self.look)


def check(
    check_id: str,
    title: str = "",
    section: str = "",
    needs: Need | tuple[Need, ...] = (),
    *,
    look: str = "",
    timeless: bool = False,
    eager: bool = False,
) -> Callable[[_Function], _Function]:
    """Register a function of a submission as a check: one line of the report.

    title: by default the first line of its docstring. needs: the checks that must hold first, as
    functions, or as ids ("C2 C12") if they are in another section. See Check.
    """
    ids = _ids_of(check_id, needs if isinstance(needs, tuple) else (needs,))

    def keep(function: _Function) -> _Function:
        name = title or _title_of(function)
        if not name or not section:
            raise ValueError(f"{check_id}: a check has a title, or a docstring, and a section")
        about = "", name, section, cast(CheckFunction, function), ids, look, timeless, eager
        _checks.append(Check(check_id, *about))
        return function

    return keep


def _title_of(function: Callable[..., object]) -> str:
    """Return the first line of a docstring as a title: "It drives." is "it drives"."""
    line = (function.__doc__ or "").strip().partition("\n")[0].rstrip(".")
    word = line.partition(" ")[0]
    return line[:1].lower() + line[1:] if word.istitle() and word.isalpha() else line


def _ids_of(check_id: str, needs: Iterable[Need]) -> tuple[str, ...]:
    """Return the ids of checks. Raises ValueError for a function that is no check."""
    ids = {check.function: check.id for check in _checks}
    names: list[str] = []
    for need in needs:
        if not isinstance(need, str) and need not in ids:
            raise ValueError(f"{check_id} needs {need.__name__}, which is no check")
        names += need.split() if isinstance(need, str) else [ids[need]]
    return tuple(names)


@functools.lru_cache(maxsize=8)
def checks_of(course: Course) -> list[Check]:
    """Load the files of a course, once; return its checks in order. Raises CannotCheck.

    Call it before threads start: while one loads a course, another would see half of it.
    """
    checks: dict[str, Check] = {}
    for check in _registered(load(course)):
        exercise = course.exercise_of(check.section)
        if not exercise:
            raise CannotCheck(f"{check.id}: section {check.section} is of no exercise of {FILE}")
        if check.id in checks:
            raise CannotCheck(f"two checks are {check.id}; each needs a name of its own")
        section = f"{course.exercises[exercise].document} {check.section}"
        checks[check.id] = replace(check, exercise=exercise, section=section)
    for check in checks.values():
        lost = set(check.needs) - checks.keys()
        if lost:
            raise CannotCheck(f"{check.id} needs {', '.join(sorted(lost))}, which is no check")
    order = list(course.exercises)

    def place_of(check: Check) -> tuple[int, int]:
        return order.index(check.exercise), int(re.sub(r"\D", "", check.id) or 0)  # 12 of C12

    return sorted(checks.values(), key=place_of)


def _registered(names: set[str]) -> list[Check]:
    """Return the checks of these modules. A check that is loaded again replaces the earlier one."""
    newest = {(check.function.__module__, check.function.__qualname__): check for check in _checks}
    return [check for (module, _), check in newest.items() if module in names]


class CheckRunner:
    """Runs each check at most once, and only if the checks that it needs hold."""

    def __init__(self, checks: Iterable[Check], submission: Submission) -> None:
        self._checks = {check.id: check for check in checks}
        self._submission = submission
        self._done: dict[str, Result] = {}
        self._blamed: dict[str, list[Result]] = {}  # by check
        self._reported: set[str] = set()
        self._troubles: dict[str, str] = {}  # {check that could not run: why}

    def result(self, check_id: str) -> Result:
        if check_id not in self._done:
            self._done[check_id] = self._make(self._checks[check_id])
        return self._done[check_id]

    def exercise(self, exercise: str, only_first: bool = False) -> Iterator[Result]:
        """Yield the results of an exercise as they come. only_first: up to the first wrong one.

        A mistake in an earlier exercise that blocks this one comes first.
        """
        is_wrong = False
        for check in self._of(exercise):
            culprits = {c.id: c for c in self._culprits(check) if c.id not in self._reported}
            earlier = [c for c in culprits.values() if self._checks[c.id].exercise != exercise]
            for result in (*earlier, self.result(check.id)):
                if result.id not in self._reported or result.status != WRONG:
                    is_wrong = is_wrong or result.status == WRONG
                    self._reported.add(result.id)
                    yield result
            if only_first and is_wrong:
                return

    def trouble(self, exercise: str) -> str:
        """Return why a check of the exercise could not run, through no fault of the student's."""
        troubles = (self._troubles.get(check.id, "") for check in self._of(exercise))
        return next(filter(None, troubles), "")

    def _of(self, exercise: str) -> list[Check]:
        return [check for check in self._checks.values() if check.exercise == exercise]

    def _culprits(self, check: Check) -> list[Result]:
        """Return the wrong results that block a check; this runs the checks that it needs."""
        lost = (name for name in check.needs if self.result(name).status in (WRONG, UNREACHED))
        return [culprit for name in lost for culprit in self._blamed[name]]

    def _make(self, check: Check) -> Result:
        culprits = self._culprits(check)
        try:
            if not culprits:
                verdict = self._final_verdict(check)
                return check.result(NOTE if isinstance(verdict, Note) else OK, verdict)
        except Wrong as wrong:
            # One cause is reported once, at the first check that it makes fail.
            culprits = self._same_cause(wrong)
            result = check.result(WRONG, wrong)
        except Exception as error:  # also a bug of ours: the other checks still run
            self._troubles[check.id] = f"{check.id}: {fault(error)}"
            result = check.result(UNREACHED, f"could not be checked: {fault(error)}")
        if culprits:
            first = culprits[0]
            todo = f"first fix {first.id}: {first.title}"
            lost = f"{first.id} could not be checked"
            result = check.result(UNREACHED, lost if first.status == UNREACHED else todo)
        self._blamed[check.id] = culprits or [result]
        return result

    def _same_cause(self, wrong: Wrong) -> list[Result]:
        """Return wrong results with the same cause. "No such file" alone may concern two files."""
        about, is_line = (WRONG, wrong.seen, wrong.where), LINE.search(wrong.where)
        same = [r for r in self._done.values() if (r.status, r.seen, r.where) == about]
        return [result for result in same if is_line or result.expected == wrong.expected]

    def _final_verdict(self, check: Check) -> Verdict:
        """Run a check; if that may help, run it again with new recordings."""
        try:
            return self._verdict(check)
        except CannotCheck:
            pass
        except Wrong as wrong:
            if not self._is_worth_a_retry(check, wrong):
                raise
        self._submission.forget_recordings()
        try:
            return self._verdict(check)
        except Wrong as wrong:
            if wrong.sure or not self._submission.overloaded():
                raise
            why = f"the machine is too busy for a verdict ({wrong.seen})"
            raise CannotCheck(f"{check.id}: {why}") from None

    def _is_worth_a_retry(self, check: Check, wrong: Wrong) -> bool:
        """Return whether programs may behave differently next time.

        They may on a busy machine, or if no line explains the mistake: the nodes of a launch file
        connect in any order, and a Ctrl-C in the middle of a publish may leave rospy hanging.
        """
        if wrong.sure or check.timeless or self._same_cause(wrong):
            return False
        return self._submission.busy() or not LINE.search(wrong.where)

    def _verdict(self, check: Check) -> Verdict:
        try:
            return check.function(self._submission)
        except (CutShort, FileTooLarge) as end:
            raise wrong_of(end) from None
