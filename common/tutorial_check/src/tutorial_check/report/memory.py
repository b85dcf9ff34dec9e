"""Results of earlier checks, for graded hints, and so that --all checks only what has changed.

A hint is shown when the same mistake is made again. The mistakes and the exercises done are kept in
the user's cache, for each workspace; those of --all are kept beside the table.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import tempfile
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, Dict, Iterable, Sequence

from tutorial_check.checking.results import WRONG, Outcome, Result
from tutorial_check.course.definition import HANDOUT, SUITE, Course, sources_of
from tutorial_check.errors import CannotCheck
from tutorial_check.report.class_page import Student, cause_of
from tutorial_check.submission.handed_in import all_below

NEVER, AGAIN, ALWAYS = 0, 1, 2  # --hints
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache", "ros1_tutorial", "checked.json")
State = Dict[str, Any]  # {workspace or student: what is kept}
STATE = ".state.json"  # beside the table, where no student's program reaches it
MOST_BYTES = 200_000_000  # per student; a larger submission is not remembered
LATER = "check again to see it here, or with --hints 2"


def read_state(file: Path) -> State:
    """Return what write_state has written; empty if the file is missing or broken."""
    with contextlib.suppress(OSError, ValueError):
        state = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(state, dict):
            return state
    return {}


def write_state(file: Path, state: State) -> None:
    """Write a file atomically; ignore errors."""
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        # Hidden, because a process killed here leaves it behind, beside a class's reports.
        descriptor, name = tempfile.mkstemp(file.suffix, f".{file.stem}.", file.parent)
        with open(descriptor, "w", encoding="utf-8") as written:
            json.dump(state, written)
        os.replace(name, file)


class Memory:
    """The results of the last check of a workspace."""

    def __init__(self, workspace: str, course: Course, level: int, cache: Path = CACHE) -> None:
        """level: NEVER, AGAIN or ALWAYS. A memory that cannot be read is empty."""
        self._level, self._cache = level, cache.expanduser()
        self._key = f"{os.path.realpath(workspace)}\n{course.title}"
        about = read_state(self._cache).get(self._key, {})
        about = about if isinstance(about, dict) else {}
        self._wrong, self.done = about.get("wrong", []), about.get("done", [])

    def hint_of(self, result: Result) -> str:
        """Return the hint for a result, or when it will be shown, or ""."""
        if self._level == NEVER or not result.hint:
            return ""
        is_due = self._level == ALWAYS or result.status != WRONG or result.eager
        return result.hint if is_due or cause_of(result) in self._wrong else LATER

    def keep(self, outcomes: Sequence[Outcome]) -> None:
        """Remember these outcomes; those of other exercises stay as they are."""
        checked = {outcome.id for outcome in outcomes}
        now = {cause_of(result) for outcome in outcomes for result in outcome.wrong}
        made = {result.id for outcome in outcomes for result in outcome.results}
        before = [cause for cause in self._wrong if cause.split()[0] not in made]
        self._wrong = sorted({*before, *now})
        self.done = [name for name in self.done if name not in checked]
        self.done += [outcome.id for outcome in outcomes if outcome.solved]
        known = read_state(self._cache)
        there = {key: known[key] for key in known if os.path.exists(key.split("\n")[0])}
        # If it cannot be written, each failure counts as the first.
        write_state(self._cache, {**there, self._key: {"wrong": self._wrong, "done": self.done}})


def show_solution(course: Course, exercises: Sequence[str], memory: Memory) -> None:
    """Print the course's solution of exercises that are done. Raises CannotCheck."""
    for name in exercises:
        files = course.exercises[name].solution
        if not files:
            raise CannotCheck(f"{name}: this course has no solution to show")
        if name not in memory.done:
            raise CannotCheck(f"{name} is not done yet: its solution is shown when its check is ok")
        for file in files:
            path = (course.folder / file).resolve()
            if (SUITE if course.folder == HANDOUT else course.folder) not in path.parents:
                raise CannotCheck(f"{name}: {file} is no file of the course's folder")
            try:
                text = path.read_text(encoding="utf-8")
            except OSError as error:
                raise CannotCheck(f"{path}: {error.strerror}") from None
            print(f"# {name}: {path}\n{text}")


class LastRun:
    """The outcomes of the last run, by student. A broken file counts as empty."""

    def __init__(self, out: Path) -> None:
        """out: the folder of the results."""
        self._file = out / STATE
        self._state = read_state(self._file)

    def outcomes(self, name: str) -> list[Outcome]:
        """Return a student's outcomes of the last run; empty if there are none."""
        with contextlib.suppress(KeyError, TypeError):
            return [
                Outcome(**{**outcome, "results": [Result(**words) for words in outcome["results"]]})
                for outcome in self._state[name]["outcomes"]
            ]
        return []

    def is_same(self, student: Student) -> bool:
        """Return whether the last run checked the same submission and reached a verdict."""
        if not student.before or not student.digest:
            return False
        digest = self._state[student.name].get("digest")
        return digest == student.digest and not any(old.trouble for old in student.before)

    def keep(self, students: Iterable[Student]) -> None:
        """Write the outcomes for the next run; students not checked yet keep their old ones."""
        state = {}
        for student in students:
            if student.outcomes:
                outcomes = [asdict(replace(outcome, recordings=[])) for outcome in student.outcomes]
                state[student.name] = {"digest": student.digest, "outcomes": outcomes}
            elif student.name in self._state and not student.trouble:
                state[student.name] = self._state[student.name]
        write_state(self._file, state)  # if not, all are checked again


def digest_of_checks(course: Course, exercises: Iterable[str], hints: int) -> str:
    """Return a digest of the checker, the course, the exercises and the hints."""
    package = Path(__file__).parents[1]
    kinds = ("*.py", "*.yaml", "*.txt")
    sources = [path for kind in kinds for path in sorted(package.rglob(kind))]
    digest = hashlib.sha256(json.dumps([list(exercises), hints == 0]).encode())
    for path in (*sources, *sources_of(course.folder)):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def digest_of(path: Path, checks: str) -> str:
    """Return a digest of a submission and its checks; empty if it has none.

    Raises CannotCheck.
    """
    digest, left = hashlib.sha256(checks.encode()), MOST_BYTES
    try:
        for file in all_below(path) if path.is_dir() else [str(path)]:
            about = os.lstat(file)
            name = f"{os.path.relpath(file, path)} {about.st_mode}\0"
            digest.update(name.encode("utf-8", "replace"))
            if os.path.islink(file):
                digest.update(os.fsencode(os.readlink(file)))
            elif os.path.isfile(file):  # not a pipe, which would never end
                left -= about.st_size
                if left < 0:
                    return ""
                with open(file, "rb") as opened:
                    for block in iter(lambda: opened.read(1 << 20), b""):
                        digest.update(block)
    except OSError:
        return ""
    return digest.hexdigest()
