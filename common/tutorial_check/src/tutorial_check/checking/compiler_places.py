"""The student's line that an error of the compiler is about."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from itertools import islice, takewhile
from pathlib import Path
from typing import Iterator

from tutorial_check.checking.submission import Submission
from tutorial_check.errors import CannotCheck

# Bounded, because an unbounded search takes quadratic time.
ERROR = re.compile(
    r"^(/[^\s:]{1,500}):(\d{1,9}):(?:(\d{1,9}):)? (?:fatal )?error: ([^\n]{1,2000})", re.M
)
# Lines before an error: the files that include its file, and what instantiates its template; g++ 14
# quotes each line.
CONTEXT = re.compile(
    r"In file included from |\s+from |/\S+ (?:In|At) |/\S+\s+(?:required|recurs)| *\d* \|"
)
BEFORE = 60_000  # characters in which they are
PLACE = re.compile(r"(?<!\S)(/[^\s:]{1,500}):(\d{1,9})[:,](?:\d{1,9}: +(required))?")
MOST_PLACES = 500
NESTED = "#include nested depth"  # the file is innocent, its #include is to blame
UNENDED = "new types may not be defined"  # in a return type, such as a class without its ;
MOST_TEXT = 300  # characters of a line
LACKS_SEMICOLON = re.compile(r"expected (?:.,. or )?(?:.;. |initializer )before")
OPENED = re.compile(r"^(/[^\s:]{1,500}):(\d{1,9}):\d{1,9}: note: to match this", re.M)
CLASSES = ("class ", "struct ")
# Lines that begin a block, or end the one before.
HEADS = (*CLASSES, "int ", "void ", "bool ", "double ", "float ", "static ", "}")
TAB = 8  # columns, for g++


@dataclass(frozen=True)
class Place:
    """A line of a file in the copy of the workspace."""

    path: str
    line: int

    def shown(self, submission: Submission) -> str:
        """Return FILE:LINE, the file within src."""
        return f"{_inside(submission, self.path)}:{self.line}"

    def text(self, submission: Submission) -> str:
        """Return the line, or its start if it is long; "" if it cannot be read."""
        lines = text_of(submission, self.path).split("\n")[self.line - 1 : self.line]
        return "".join(lines)[:MOST_TEXT]


def own_place(submission: Submission, output: str, error: re.Match[str]) -> Place | None:
    """Return the student's line that an error, a match of ERROR, is about."""
    place = Place(error[1], int(error[2]))
    if submission.is_own(place.path) and NESTED not in error[4]:
        return _corrected(submission, output, error, place)
    # The compiler often reports an error in a template at the system's header.
    before = output[max(0, error.start() - BEFORE) : error.start()].splitlines()
    context = "\n".join([*takewhile(CONTEXT.match, before[::-1])][::-1])
    places = _own(submission, PLACE.finditer(context))
    required = [place for place in places if place[3]]
    places = required[-1:] or places or _own(submission, PLACE.finditer(output))
    if not places:
        return None
    place = Place(places[0][1], int(places[0][2]))
    return place if required else _callback(submission, error, place)


def _own(submission: Submission, places: Iterator[re.Match[str]]) -> list[re.Match[str]]:
    return [place for place in islice(places, MOST_PLACES) if submission.is_own(place[1])]


def _corrected(submission: Submission, output: str, error: re.Match[str], place: Place) -> Place:
    """Return where the mistake is, if the compiler notices it only later."""
    message = error[4]
    if LACKS_SEMICOLON.search(message):
        return _line_before(submission, place, int(error[3] or 0))
    if UNENDED in message:
        return _end_of_block(submission, place)
    other = None
    if "at end of input" in message:
        other = OPENED.search(output, error.end())
    elif "unterminated argument list" in message:
        other = ERROR.search(output, error.end())
    is_own = other and submission.is_own(other[1])
    return Place(other[1], int(other[2])) if other and is_own else place


def _callback(submission: Submission, error: re.Match[str], place: Place) -> Place:
    """Return the line of a callback whose parameter is not const; the compiler names only files."""
    if "ros::ParameterAdapter<" not in error[4]:
        return place
    lines = text_of(submission, place.path).split("\n")
    numbers = (n for n, line in enumerate(lines, 1) if re.search(r"\bsubscribe\s*[<(]", line))
    return Place(place.path, next(numbers, place.line))


def _line_before(submission: Submission, place: Place, column: int) -> Place:
    """Return the line with the last code before a column; comments and blank lines have none."""
    lines = text_of(submission, place.path).split("\n")[: place.line]
    class_end = _class_end(lines[:-1])
    if class_end:
        return Place(place.path, class_end)
    indents = {len(text) - len(text.lstrip()) for text in (lines[-1], lines[-1].expandtabs(TAB))}
    if column - 1 not in indents:
        return place
    numbers = range(len(lines) - 1, 0, -1)
    codes = (n for n in numbers if lines[n - 1].strip() and lines[n - 1].lstrip()[0] not in "/*#")
    return Place(place.path, next(codes, place.line))


def _class_end(lines: list[str]) -> int:
    """Return the number of the last line if it is a } that ends a class; else 0."""
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    if not lines or lines[-1].rstrip() != "}":
        return 0
    heads = (line for line in lines[-2::-1] if line.startswith(HEADS))
    return len(lines) if next(heads, "").startswith(CLASSES) else 0


def _end_of_block(submission: Submission, place: Place) -> Place:
    """Return the line with the } that is indented like the start of a block."""
    lines = text_of(submission, place.path).split("\n")
    start = lines[place.line - 1] if place.line <= len(lines) else ""
    end = f"{start[: len(start) - len(start.lstrip())]}}}"
    numbers = range(place.line + 1, len(lines) + 1)
    return Place(place.path, next((n for n in numbers if lines[n - 1].rstrip() == end), place.line))


def _inside(submission: Submission, path: str | Path) -> str:
    """Return the path of a student's file within src."""
    return os.path.relpath(os.path.realpath(path), os.path.realpath(submission.source))


def text_of(submission: Submission, path: str | Path) -> str:
    """Return the text of a student's file; "" if it cannot be read."""
    try:
        return submission.read(submission.source / _inside(submission, path))
    except CannotCheck:
        return ""
