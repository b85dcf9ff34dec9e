"""--self-test: every right solution of a course passes, every wrong one fails at the named check."""

from __future__ import annotations

import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Iterator

from tutorial_check.course import Course
from tutorial_check.launcher import Outcome, examine
from tutorial_check.model import CannotCheck

SOLUTIONS, RIGHT, WRONG_OF = "solutions", "right", "wrong_"


def solutions(course: Course) -> Iterator[tuple[str, str, list[Path]]]:
    """Yield (name, the check that it fails at or "", folders that are put one over the other).

    solutions/right, and right_WHAT, are packages; wrong_CHECK_WHAT has what differs from right.
    Raises CannotCheck.
    """
    folder = course.folder / SOLUTIONS
    right = folder / RIGHT
    if not right.is_dir():
        raise CannotCheck(f"{right}: no such folder; a self-test needs a right solution")
    for path in sorted(each for each in folder.iterdir() if each.is_dir()):
        if path.name.startswith(RIGHT):
            yield path.name, "", [path]
        elif path.name.startswith(WRONG_OF):
            yield path.name, path.name.split("_")[1], [right, path]
        else:
            raise CannotCheck(f"{path}: call it {RIGHT}_WHAT, or {WRONG_OF}CHECK_WHAT")


def self_test(course: Course, underlay: str, jobs: int) -> int:
    """Check all solutions of a course, a line each; return 0 if all come to what they should."""
    failed, every = 0, list(solutions(course))
    with ThreadPoolExecutor(jobs) as pool:
        examined = pool.map(lambda one: _examined(course, underlay, one[2]), every)
        for (name, check, _), outcomes in zip(every, examined):
            complaint = complaint_of(check, outcomes)
            failed += bool(complaint)
            seen = [one.seen for outcome in outcomes for one in outcome.wrong if one.id == check]
            word = "FAILED" if complaint else "ok"
            print(f"{word:<7}{name}: {complaint or [*seen, 'passes'][0]}", flush=True)
    print(f"{failed} of the solutions failed" if failed else f"all solutions of {course.title}")
    return int(bool(failed))


def _examined(course: Course, underlay: str, folders: list[Path]) -> list[Outcome]:
    with tempfile.TemporaryDirectory() as scratch:
        for folder in folders:
            shutil.copytree(folder, scratch, dirs_exist_ok=True)
        return examine(scratch, underlay, list(course.exercises), own=False, course=course.folder)


def complaint_of(check: str, outcomes: list[Outcome]) -> str:
    """Return what is wrong with the outcomes of a solution that must fail at a check, or ""."""
    for one in outcomes:
        if one.trouble:
            return f"could not be checked: {one.id}: {one.trouble}"
    wrong = [result for outcome in outcomes for result in outcome.wrong]
    if not check:
        return f"{wrong[0].id} is wrong: {wrong[0].seen}" if wrong else ""
    if not wrong:
        return f"{check} should be wrong, and nothing is"
    if wrong[0].id != check:
        return f"{check} should be the first that is wrong, and {wrong[0].id} is: {wrong[0].seen}"
    return ""
