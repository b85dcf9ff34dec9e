"""--self-test: right solutions of a course must pass, wrong ones must fail at the named check."""

from __future__ import annotations

import re
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Iterator

from tutorial_check.checking.checks import checks_of
from tutorial_check.checking.results import UNREACHED, WRONG, Outcome
from tutorial_check.course.definition import SOLUTIONS, Course
from tutorial_check.errors import CannotCheck
from tutorial_check.examining.examination import examine
from tutorial_check.sandbox.environment import copy_tree
from tutorial_check.submission.order import Order

RIGHT, WRONG_OF, PATCH = "right", "wrong_", ".patch"
GONE = "/dev/null"
FILES = re.compile(r"^--- (\S+).*\n\+\+\+ (\S+).*\n((?:(?!--- ).*\n)*)", re.MULTILINE)
HUNK = re.compile(r"^@@.*\n((?:[ +-].*\n|\n)*)", re.MULTILINE)


def solutions(course: Course) -> Iterator[tuple[str, str, list[Path]]]:
    """Yield (name, the check at which it fails or "", layers: each overwrites the ones before).

    solutions/right, and right_WHAT, are packages; wrong_CHECK_WHAT are files or a .patch of right,
    or of right_cpp if WHAT begins with cpp_.
    """
    folder = course.folder / SOLUTIONS
    right = folder / RIGHT
    if not right.is_dir():
        raise CannotCheck(f"{right}: no such folder; a self-test needs a right solution")
    paths = (path for path in folder.iterdir() if path.is_dir() or path.suffix == PATCH)
    for path in sorted(paths):
        if path.name.startswith(WRONG_OF):
            check, _, what = path.stem[len(WRONG_OF) :].partition("_")
            below = f"{right}_cpp" if what.startswith("cpp_") else right
            yield path.stem, check, [Path(below), path]
        elif path.name.startswith(RIGHT):
            yield path.stem, "", [path] if path.is_dir() else [right, path]
        else:
            raise CannotCheck(f"{path}: call it {RIGHT}_WHAT, or {WRONG_OF}CHECK_WHAT")


def self_test(course: Course, underlay: str, jobs: int) -> int:
    """Check all solutions of a course, and print a line for each; return 0 if all are as named."""
    failed, every = 0, list(solutions(course))
    exercises = {check.id: [check.exercise] for check in checks_of(course)}
    with ThreadPoolExecutor(jobs) as pool:
        tests = [pool.submit(_examined, course, underlay, exercises, *about) for about in every]
        for (name, check, _), test in zip(every, tests):
            outcomes = test.result()
            complaint = complaint_of(check, outcomes)
            failed += bool(complaint)
            wrongs = [wrong for outcome in outcomes for wrong in outcome.wrong if wrong.id == check]
            causes = [": ".join(filter(None, (wrong.where, wrong.seen))) for wrong in wrongs]
            word = "FAILED" if complaint else "ok"
            print(f"{word:<7}{name}: {complaint or [*causes, 'passes'][0]}", flush=True)
    print(f"{failed} of the solutions failed" if failed else f"all solutions of {course.title}")
    return int(bool(failed))


def _examined(
    course: Course, underlay: str, exercises: dict[str, list[str]],
    _: str, check: str, layers: list[Path],
) -> list[Outcome]:  # fmt: skip
    """Check a solution: a right one in all exercises, a wrong one in that of its check."""
    with tempfile.TemporaryDirectory() as scratch:
        for layer in layers:
            try:
                if layer.is_dir():
                    copy_tree(layer, Path(scratch))
                else:
                    patch(Path(scratch), layer)
            except CannotCheck as why:
                return [Outcome(check, trouble=str(why))]
        wanted = tuple(exercises.get(check, course.exercises))
        return examine(Order(Path(scratch), underlay, wanted, bool(check), False, course.folder))


def patch(folder: Path, file: Path) -> None:
    """Apply git's unified diff, whatever its line numbers are. Raises CannotCheck."""
    for before, after, hunks in FILES.findall(file.read_text(encoding="utf-8")):
        path = folder / re.sub(r"^(\.\./)*[^/]*/", "", before if after == GONE else after)
        if ".." in path.parts or (before != GONE and not path.is_file()):
            raise CannotCheck(f"{file}: there is no {path.relative_to(folder)}")
        if after == GONE:
            path.unlink()
            continue
        done, text = "", path.read_text(encoding="utf-8") if path.exists() else ""
        for hunk in HUNK.findall(hunks):
            lines = [line if line != "\n" else " \n" for line in hunk.splitlines(keepends=True)]
            old, new = ("".join(line[1:] for line in lines if line[0] != sign) for sign in "+-")
            if text and text.count(old) != 1:
                count, first = text.count(old), old.split("\n", 1)[0]
                raise CannotCheck(f"{file}: {path.name} has {count} places for: {first} ...")
            above, text = text.split(old) if old else ("", "")
            done += above + new
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(done + text, encoding="utf-8")
        path.chmod(0o755 if done.startswith("#!") else path.stat().st_mode)


def complaint_of(check: str, outcomes: list[Outcome]) -> str:
    """Return how the outcomes of a solution differ from its name, or ""."""
    for outcome in outcomes:
        if outcome.trouble:
            return f"could not be checked: {outcome.id}: {outcome.trouble}"
    results = [result for outcome in outcomes for result in outcome.results]
    first = next((result for result in results if result.status == WRONG), None)
    if first is None:
        missed = (f"; {r.id} was not reached" for r in results if r.status == UNREACHED)
        return check and f"{check} should be wrong, and nothing is{next(missed, '')}"
    if not check:
        return f"{first.id} is wrong: {first.seen}; hint: {first.hint}"
    seen = f"{check} should be the first that is wrong, and {first.id} is: {first.seen}"
    return "" if first.id == check else seen
