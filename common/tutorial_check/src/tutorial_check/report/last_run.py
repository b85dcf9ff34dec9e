"""What the last --all found, so that only what changed since then is checked again."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import json
import os
from pathlib import Path
from typing import Iterable

from tutorial_check.course import FILE, Course
from tutorial_check.launcher import Outcome
from tutorial_check.model import Result
from tutorial_check.report.class_page import Student
from tutorial_check.report.hints import read_state, write_state
from tutorial_check.source.workspace import all_below

STATE = ".state.json"  # beside the table, out of reach of what is checked
MOST_BYTES = 200_000_000  # per student; a larger one is not remembered


class LastRun:
    """The outcomes of the last run, by the name of the student. A file that is broken is empty."""

    def __init__(self, out: Path) -> None:
        """out: the folder of the results."""
        self._file = out / STATE
        self._found = read_state(self._file)

    def outcomes(self, name: str) -> list[Outcome]:
        """Return what came of a student in the last run; empty if there is nothing."""
        with contextlib.suppress(KeyError, TypeError):
            return [
                Outcome(**{**one, "results": [Result(**each) for each in one["results"]]})
                for one in self._found[name]["outcomes"]
            ]
        return []

    def is_same(self, name: str, digest: str) -> bool:
        """Return whether the last run checked the same, and came to a verdict."""
        outcomes = self.outcomes(name)
        same = bool(digest and outcomes) and self._found[name].get("digest") == digest
        return same and not any(one.trouble for one in outcomes)

    def keep(self, students: Iterable[tuple[Student, str]]) -> None:
        """Write (student, digest) of all for the next run; students not checked yet keep what they had."""
        found = {}
        for student, digest in students:
            if student.outcomes:
                outcomes = [
                    dataclasses.asdict(dataclasses.replace(one, recordings=[]))
                    for one in student.outcomes
                ]
                found[student.name] = {"digest": digest, "outcomes": outcomes}
            elif student.name in self._found and not student.trouble:
                found[student.name] = self._found[student.name]
        write_state(self._file, found)  # or all are checked again


def digest_of_checks(course: Course, exercises: Iterable[str], hints: int) -> str:
    """Return what makes two runs the same: the checker, the course, the exercises and the hints."""
    package = Path(__file__).parents[1]
    kinds = ("*.py", "*.yaml", "*.txt")
    sources = [path for kind in kinds for path in sorted(package.rglob(kind))]
    digest = hashlib.sha256(json.dumps([list(exercises), hints == 0]).encode())
    for path in (*sources, course.folder / FILE, *sorted(course.folder.glob("*.py"))):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def digest_of(path: Path, checks: str) -> str:
    """Return a digest of what a student handed in, and of what checks it; empty if it has none."""
    digest, left = hashlib.sha256(checks.encode()), MOST_BYTES
    try:
        for file in all_below(path) if path.is_dir() else [str(path)]:
            about = os.lstat(file)
            name = f"{os.path.relpath(file, path)} {about.st_mode}\0"
            digest.update(name.encode("utf-8", "replace"))
            if os.path.islink(file):
                digest.update(os.fsencode(os.readlink(file)))
            elif os.path.isfile(file):  # no pipe, which would never end
                left -= about.st_size
                if left < 0:
                    return ""
                digest.update(Path(file).read_bytes())
    except OSError:
        return ""
    return digest.hexdigest()
