"""Graded hints: what is wrong comes first; how to fix it, when the same is wrong again.

What was wrong and what was done is remembered in the cache, for each workspace, and not in it.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import tempfile
from pathlib import Path
from typing import Any, Dict, Sequence

from tutorial_check.course import OURS, Course
from tutorial_check.launcher import SUITE, Outcome
from tutorial_check.model import WRONG, CannotCheck, Result

NEVER, AGAIN, ALWAYS = 0, 1, 2  # --hints
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache", "ros1_tutorial", "checked.json")
State = Dict[str, Any]  # {workspace or student: what is kept of it}
LATER = "check once more, and it is here; or with --hints 2"


def cause_of(result: Result) -> str:
    """Return what makes two failures the same: the check and its words, without their numbers."""
    return f"{result.id} {re.sub('[0-9.]+', '#', result.seen)}"


def read_state(file: Path) -> State:
    """Return what write_state has written; empty if it is not there or broken."""
    with contextlib.suppress(OSError, ValueError):
        found = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(found, dict):
            return found
    return {}


def write_state(file: Path, state: State) -> None:
    """Write a file in one step, if it can be written."""
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        # Hidden: one that is killed now leaves it behind, beside the reports of a class.
        descriptor, name = tempfile.mkstemp(file.suffix, f".{file.stem}.", file.parent)
        with open(descriptor, "w", encoding="utf-8") as written:
            json.dump(state, written)
        os.replace(name, file)


class Memory:
    """What the last check of a workspace found."""

    def __init__(self, workspace: str, course: Course, level: int, cache: Path = CACHE) -> None:
        """level: NEVER, AGAIN or ALWAYS. A memory that cannot be read is empty."""
        self._level, self._cache = level, cache.expanduser()
        self._key = f"{os.path.realpath(workspace)}\n{course.title}"
        about = read_state(self._cache).get(self._key, {})
        about = about if isinstance(about, dict) else {}
        self._wrong, self.done = about.get("wrong", []), about.get("done", [])

    def hint_of(self, result: Result) -> str:
        """Return the hint for a result, or when there will be one, or ""."""
        if self._level == NEVER or not result.hint:
            return ""
        shown = self._level == ALWAYS or result.status != WRONG or result.eager
        return result.hint if shown or cause_of(result) in self._wrong else LATER

    def keep(self, outcomes: Sequence[Outcome]) -> None:
        """Remember what these came to; what was not checked stays as it was."""
        checked = {outcome.id for outcome in outcomes}
        now = {cause_of(one) for each in outcomes for one in each.wrong}
        made = {one.id for each in outcomes for one in each.results}
        before = [cause for cause in self._wrong if cause.split()[0] not in made]
        self._wrong = sorted({*before, *now})
        self.done = [each for each in self.done if each not in checked]
        self.done += [one.id for one in outcomes if one.solved]
        known = read_state(self._cache)
        there = {key: known[key] for key in known if os.path.exists(key.split("\n")[0])}
        about = {"wrong": self._wrong, "done": self.done}
        # Without a memory each failure is a first one.
        write_state(self._cache, {**there, self._key: about})


def show_solution(course: Course, exercises: Sequence[str], memory: Memory) -> None:
    """Print the course's own solution of exercises that are done. Raises CannotCheck."""
    for name in exercises:
        files = course.exercises[name].solution
        if not files:
            raise CannotCheck(f"{name}: this course has no solution to show")
        if name not in memory.done:
            raise CannotCheck(f"{name} is not done yet: its solution is shown when its check is ok")
        for file in files:
            path = (course.folder / file).resolve()
            if (SUITE if course.folder == OURS else course.folder) not in path.parents:
                raise CannotCheck(f"{name}: {file} is no file of the course's folder")
            try:
                text = path.read_text(encoding="utf-8")
            except OSError as error:
                raise CannotCheck(f"{path}: {error.strerror}") from None
            print(f"# {name}: {path}\n{text}")
