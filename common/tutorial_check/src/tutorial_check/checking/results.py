"""Verdicts of checks, and results of exercises."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable, Iterable, TypeVar

from tutorial_check.errors import (
    CANNOT_START,
    MASTER_GONE,
    MULTIPLIES,
    NO_TYPE,
    CheckerError,
    CutShort,
    FileTooLarge,
)
from tutorial_check.submission.student_files import TOO_LARGE

OK, WRONG, NOTE, UNREACHED = "ok", "wrong", "note", "unreached"
_Facts = TypeVar("_Facts")
_Finding = TypeVar("_Finding")


@dataclass(frozen=True)
class Result:
    """The result of one check, in words for the student."""

    id: str
    status: str
    title: str
    expected: str = ""
    seen: str = ""
    where: str = ""
    hint: str = ""
    section: str = ""
    look: str = ""  # a command that shows it
    empty: bool = False  # a note that there was nothing to check
    eager: bool = False  # its hint gives no answer away, so it is shown at once


@dataclass(frozen=True)
class Note:
    """A check that holds, with a remark."""

    seen: str
    where: str = ""
    hint: str = ""
    empty: bool = False  # there was nothing to check


@dataclass(eq=False)
class Wrong(CheckerError):
    """A check that does not hold. Checks raise it at the first mistake."""

    expected: str
    seen: str
    where: str = ""
    hint: str = ""
    sure: bool = False  # it does not depend on time, so a busy machine does not explain it
    look: str = ""  # a command that shows it, if not the check's own


def first_of(
    diagnoses: Iterable[Callable[[_Facts], _Finding | None]], facts: _Facts
) -> _Finding | None:
    """Return the verdict of the first diagnosis that applies to the facts, or None."""
    verdicts = (diagnosis(facts) for diagnosis in diagnoses)
    return next((verdict for verdict in verdicts if verdict is not None), None)


def must_pass(
    diagnoses: Iterable[Callable[[_Facts], Wrong | Note | None]], facts: _Facts, expected: str = ""
) -> Note | None:
    """Return the Note of the first diagnosis that applies, or None. Raises its Wrong.

    expected: for a Wrong that has none.
    """
    for diagnosis in diagnoses:
        verdict = diagnosis(facts)
        if isinstance(verdict, Wrong):
            verdict.expected = verdict.expected or expected
            raise verdict
        if verdict:
            return verdict
    return None


# {kind of a CutShort: expected, seen, hint}; all but CANNOT_START are sure.
CUT_SHORT = {
    MASTER_GONE: ("the ROS master is left alone",
        "it no longer answers: a program of yours has ended it",
        "a node ends itself (rospy.signal_shutdown), never the master"),
    MULTIPLIES: ("a program that is one process, or a few", "it starts itself again and again: {}",
        "where does it call os.fork, or start programs?"),
    NO_TYPE: ("messages and services that fit the task", "{}",
        "rosmsg show, or rossrv show, after catkin_make; CMakeLists.txt lists its file"),
    CANNOT_START: ("a program that can be started", "{}",
        "look at the first line of the file: #!/usr/bin/env python3"),
}  # fmt: skip


def wrong_of(end: CutShort | FileTooLarge, where: str = "") -> Wrong:
    """Return the Wrong for what ended a recording, or for a file that is too large."""
    if isinstance(end, FileTooLarge):
        expected, hint = "a file of a few kB", "nobody writes that much by hand: what generated it?"
        return Wrong(expected, f"{end} is {TOO_LARGE}", str(end), hint, sure=True)
    kind = end.kind if end.kind in CUT_SHORT else CANNOT_START
    expected, seen, hint = CUT_SHORT[kind]
    return Wrong(expected, seen.format(end.seen), where, hint, kind != CANNOT_START)


@dataclass
class Outcome:
    """The results of one exercise."""

    id: str
    results: list[Result] = field(default_factory=list)
    seconds: float = 0.0
    done: bool = False
    trouble: str = ""  # why a check could not run, through no fault of the student's
    title: str = ""
    points: float = 0.0  # for the whole exercise; 0: one per check
    place: str = ""  # the workspace within what was handed in, if that is another folder
    remark: str = ""  # how programs were isolated, if not by bubblewrap
    # The questions asked for these results, and not for earlier ones, with the worker's replies.
    recordings: list[dict[str, object]] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong, and every check was reached."""
        return self.done and all(result.status in (OK, NOTE) for result in self.results)

    @property
    def empty(self) -> bool:
        """Whether it passed because there was nothing to check."""
        return self.passed and bool(self.results) and all(r.empty for r in self.results)

    @property
    def solved(self) -> bool:
        return self.passed and not self.empty

    @property
    def wrong(self) -> list[Result]:
        return [result for result in self.results if result.status == WRONG]
