"""Types and constructors of rows: mistakes, right solutions, and right ones with a note."""

from dataclasses import dataclass
from typing import Callable, Dict, Sequence

from edits import Edit, put

from tutorial_check.checking.checks import checks_of
from tutorial_check.course.definition import read_course

EXERCISES = {check.id: check.exercise for check in checks_of(read_course())}


@dataclass(frozen=True)
class Mistake:
    """What a student gets wrong, the check that fails, and words of its report."""

    exercise: str
    what: str
    edits: Sequence[Edit]
    check: str
    words: Sequence[str]

    def __str__(self) -> str:
        return f"{self.exercise} {self.what}"


@dataclass(frozen=True)
class RightVariant:
    """What a student does differently from the handout, and still right in these exercises."""

    what: str
    edits: Sequence[Edit]
    exercises: Sequence[str]

    def __str__(self) -> str:
        return self.what


@dataclass(frozen=True)
class Noted(RightVariant):
    """What is right and worth a note; notes: {check: words of its note, or () for no note}."""

    notes: Dict[str, Sequence[str]]


def mistake(what: str, edits: Sequence[Edit], check: str, *words: str) -> Mistake:
    return Mistake(EXERCISES[check], what, edits, check, words)


def mistake_in(path: str, check: str, *before: Edit) -> Callable[..., Mistake]:
    """Return a constructor of mistakes that replace old by new in a file."""

    def row(what: str, old: str, new: str, *words: str) -> Mistake:
        return mistake(what, [*before, put(path, old, new)], check, *words)

    return row


def right(what: str, exercises: str, *edits: Edit) -> RightVariant:
    return RightVariant(what, edits, exercises.split())


def noted(what: str, exercises: str, edits: Sequence[Edit], **notes: Sequence[str]) -> Noted:
    return Noted(what, edits, exercises.split(), notes)
