"""What a check can come to, and the order in which checks are made. Pure."""

from __future__ import annotations

import re
import traceback
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator

from node_kit.printable import quotable

OK, WRONG, NOTE, UNREACHED = "ok", "wrong", "note", "unreached"
LINE = re.compile(r":\d+$")  # line number at the end of a place


@dataclass(frozen=True)
class Result:
    """What one check came to, in the student's words."""

    id: str
    status: str
    title: str
    expected: str = ""
    seen: str = ""
    where: str = ""
    hint: str = ""
    section: str = ""
    look: str = ""  # a command that shows it
    empty: bool = False  # a note that there was nothing to be checked
    eager: bool = False  # its hint is no answer, and shown at once


@dataclass(frozen=True)
class Note:
    """A check that holds, with something worth saying."""

    seen: str
    where: str = ""
    hint: str = ""
    empty: bool = False  # there was nothing to be checked


@dataclass(eq=False)
class Wrong(Exception):
    """A check that does not hold. Raised by checks, which so end at the first thing wrong."""

    expected: str
    seen: str
    where: str = ""
    hint: str = ""
    sure: bool = False  # whatever else the machine had to do, it is no matter of time
    look: str = ""  # a command that shows it, if not that of the check


MASTER_GONE, MULTIPLIES, CANNOT_START = "master gone", "multiplies", "cannot start"
UNREADABLE, NO_TYPE = "unreadable package.xml", "no such type"
# {kind of a CutShort: what is expected, what was seen, what to do}; all but CANNOT_START are sure.
CUT_SHORT = {
    MASTER_GONE: ("the ROS master is left alone",
        "it no longer answers: a program of yours has ended it",
        "a node ends itself (rospy.signal_shutdown), never the master"),
    MULTIPLIES: ("a program that is one process, or a few", "it starts itself again and again: {}",
        "where does it call os.fork, or start programs?"),
    NO_TYPE: ("messages and services as they are asked for", "{}",
        "rosmsg show, or rossrv show, after catkin_make; CMakeLists.txt lists its file"),
    CANNOT_START: ("a program that can be started", "{}",
        "look at the first line of the file: #!/usr/bin/env python3"),
}  # fmt: skip


@dataclass
class CutShort(Exception):
    """Nothing more can be recorded. kind: one of those above. seen: more about it."""

    kind: str
    seen: str = ""

    def as_wrong(self, where: str = "") -> Wrong:
        kind = self.kind if self.kind in CUT_SHORT else CANNOT_START
        expected, seen, hint = CUT_SHORT[kind]
        return Wrong(expected, seen.format(self.seen), where, hint, kind != CANNOT_START)


class CannotCheck(Exception):
    """The checker cannot work, through no fault of the student's; the text says why in one line."""


def fault(error: Exception) -> str:
    """Return in one line why an exception keeps the checker from working; where, if it is a bug."""
    if isinstance(error, CannotCheck):
        return quotable(str(error))
    line = traceback.extract_tb(error.__traceback__)[-1]
    where = f"({Path(line.filename).name}:{line.lineno})"
    return quotable(f"{type(error).__name__}: {error} {where}")


@dataclass(frozen=True)
class Check:
    """One line of the report."""

    id: str
    exercise: str
    title: str
    section: str  # in the course: "handout 4.3"
    needs: tuple[str, ...] = ()  # ids of the checks without which this one says nothing
    look: str = ""
    timeless: bool = False  # it reads files alone: no machine is too busy for that
    eager: bool = False  # its hint is about the set-up, and shown at once
    function: Callable[[Any], Any] = lambda session: None  # returns a text, a Note or None

    def result(self, status: str, found: Wrong | Note | str = "") -> Result:
        """Return a Result. found: what was seen, or all that is said of it."""
        one = Note(found) if isinstance(found, str) else found
        about = self.title, "", one.seen, one.where, one.hint, self.section, self.look
        result = Result(self.id, status, *about, eager=self.eager)
        if isinstance(one, Note):
            return replace(result, empty=one.empty)
        return replace(result, expected=one.expected, look=one.look or self.look)


class Run:
    """Makes checks, each at most once, and none that needs one which does not hold."""

    def __init__(
        self,
        checks: Iterable[Check],
        session: object,
        second_look: Callable[[bool], bool] = lambda explained: False,
        too_busy: Callable[[], bool] = lambda: False,
    ) -> None:
        """Take checks, in order, and the session that their functions take.

        second_look(whether a line of the student's is to blame): whether to make a check that does
        not hold again. too_busy(): whether it says nothing if it does not hold then, either.
        """
        self._checks = {check.id: check for check in checks}
        self._session = session
        self._second_look, self._too_busy = second_look, too_busy
        self._done: dict[str, Result] = {}
        self._blamed: dict[str, list[Result]] = {}  # for each check that is wrong or unreached
        self._reported: set[str] = set()
        self._troubles: dict[str, str] = {}  # id of a check that could not be made: why

    def result(self, check_id: str) -> Result:
        if check_id not in self._done:
            self._done[check_id] = self._make(self._checks[check_id])
        return self._done[check_id]

    def exercise(self, exercise: str, only_first: bool = False) -> Iterator[Result]:
        """Yield the results of an exercise as they come; only_first: up to the first wrong one.

        What is wrong in an earlier exercise and keeps this one from being checked comes first.
        """
        is_wrong = False
        for check in self._of(exercise):
            found = {one.id: one for one in self._culprits(check) if one.id not in self._reported}
            others = [one for one in found.values() if self._checks[one.id].exercise != exercise]
            for result in (*others, self.result(check.id)):
                if result.id not in self._reported or result.status != WRONG:
                    is_wrong = is_wrong or result.status == WRONG
                    self._reported.add(result.id)
                    yield result
            if only_first and is_wrong:
                return

    def trouble(self, exercise: str) -> str:
        """Return why a check of the exercise could not be made, though nothing is wrong with it."""
        troubles = (self._troubles.get(check.id, "") for check in self._of(exercise))
        return next(filter(None, troubles), "")

    def _of(self, exercise: str) -> list[Check]:
        return [check for check in self._checks.values() if check.exercise == exercise]

    def _culprits(self, check: Check) -> list[Result]:
        """Return what keeps a check from being made, after the checks that it needs."""
        lost = (each for each in check.needs if self.result(each).status in (WRONG, UNREACHED))
        return [culprit for each in lost for culprit in self._blamed[each]]

    def _make(self, check: Check) -> Result:
        culprits = self._culprits(check)
        try:
            if not culprits:
                found = self._call(check)
                return check.result(NOTE if isinstance(found, Note) else OK, found or "")
        except Wrong as wrong:
            # One cause is reported once, at the first check that it keeps from holding.
            culprits = self._same_cause(wrong)
            result = check.result(WRONG, wrong)
        except Exception as error:  # also a bug of ours: the other checks are made all the same
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
        """Return wrong results of the same cause. "No such file" alone may be about two files."""
        about, is_line = (wrong.seen, wrong.where), LINE.search(wrong.where)
        same = [one for one in self._done.values() if (one.seen, one.where) == about]
        wrongs = [one for one in same if one.status == WRONG]
        return [one for one in wrongs if is_line or one.expected == wrong.expected]

    def _call(self, check: Check) -> Any:
        try:
            return check.function(self._session)
        except CannotCheck:
            self._second_look(False)
        except Wrong as wrong:
            if wrong.sure or check.timeless or self._same_cause(wrong):
                raise
            if not self._second_look(bool(LINE.search(wrong.where))):
                raise
        try:
            return check.function(self._session)
        except Wrong as wrong:
            if wrong.sure or not self._too_busy():
                raise
            why = f"the machine has too much else to do for a verdict ({wrong.seen})"
            raise CannotCheck(f"{check.id}: {why}") from None


@dataclass
class Outcome:
    """What came of one exercise."""

    id: str
    results: list[Result] = field(default_factory=list)
    seconds: float = 0.0
    done: bool = False
    trouble: str = ""  # why a check could not be made, through no fault of the student's
    title: str = ""
    points: float = 0.0  # for all of it; 0: one a check
    place: str = ""  # the workspace within what was handed in, if another folder
    remark: str = ""  # how well a program of someone else's was isolated, if not by bubblewrap
    # What was asked for these results and not before, with the answers of the worker, which see.
    recordings: list[dict[str, Any]] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong, and everything reached."""
        return self.done and all(result.status in (OK, NOTE) for result in self.results)

    @property
    def empty(self) -> bool:
        """Whether it passed because there was nothing to check."""
        return self.passed and bool(self.results) and all(each.empty for each in self.results)

    @property
    def solved(self) -> bool:
        return self.passed and not self.empty

    @property
    def wrong(self) -> list[Result]:
        return [each for each in self.results if each.status == WRONG]
