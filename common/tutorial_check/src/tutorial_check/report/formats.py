"""The report as files for other programs."""

from __future__ import annotations

import contextlib
import json
import os
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence

from node_kit.printable import printable
from tutorial_check.checking.results import NOTE, OK, UNREACHED, WRONG, Outcome
from tutorial_check.errors import CannotCheck
from tutorial_check.report.text import heading, lines_of

FIELDS = ("id", "status", "title", "expected", "seen", "where", "hint")
# {field of the result: environment variable that Classroom 50 sets for an autograder}. It refuses
# a result without them; it adds the owner and the times itself (run_entrypoint, finalize_result and
# validate_result in runner.py of github.com/foundation50/classroom50).
SUBMISSION = {
    "classroom": "CLASSROOM",
    "assignment": "ASSIGNMENT",
    "submission": "SUBMISSION_TAG",
    "commit": "COMMIT_URL",
    "release": "RELEASE_URL",
    "review": "REVIEW_URL",
}


def without_hints(outcomes: Sequence[Outcome]) -> list[Outcome]:
    bare = ([replace(result, hint="") for result in outcome.results] for outcome in outcomes)
    return [replace(outcome, results=results) for outcome, results in zip(outcomes, bare)]


def as_json(outcomes: Sequence[Outcome], with_recordings: bool = True) -> str:
    """Return one object with all exercises, checks and the recordings behind them."""
    exercises = [
        {
            "id": outcome.id,
            "passed": outcome.solved,
            "nothing_to_check": outcome.empty,
            "trouble": outcome.trouble,
            "remark": outcome.remark,
            "checks": [{name: getattr(r, name) for name in FIELDS} for r in outcome.results],
            **({"recordings": outcome.recordings} if with_recordings else {}),
        }
        for outcome in outcomes
    ]
    passed = sum(outcome.solved for outcome in outcomes)
    return json.dumps({"exercises": exercises, "passed": passed, "total": len(outcomes)}, indent=1)


def as_junit(outcomes: Sequence[Outcome]) -> str:
    """Return JUnit's XML: a suite per exercise, a case per check, and one if no verdict."""
    root = ET.Element("testsuites", name="tutorial check")
    for outcome in outcomes:
        statuses = [result.status for result in outcome.results]
        counts = {
            "tests": len(statuses) + bool(outcome.trouble),
            "failures": statuses.count(WRONG),
            "skipped": statuses.count(UNREACHED),
            "errors": int(bool(outcome.trouble)),
        }
        about = {name: str(count) for name, count in counts.items()}
        about.update(name=heading(outcome), time=f"{outcome.seconds:.2f}")
        suite = ET.SubElement(root, "testsuite", about)
        about = {"classname": f"exercise {outcome.id}"}
        for result in outcome.results:
            case = ET.SubElement(suite, "testcase", about, name=f"{result.id} {result.title}")
            tag = {WRONG: "failure", UNREACHED: "skipped", NOTE: "system-out"}.get(result.status)
            if tag:
                message = {} if result.status == NOTE else {"message": printable(result.seen)}
                inner = ET.SubElement(case, tag, message)
                if result.status != UNREACHED:
                    inner.text = printable("\n".join(line.strip() for line in lines_of(result)[1:]))
        if outcome.trouble:
            case = ET.SubElement(suite, "testcase", about, name="no verdict")
            ET.SubElement(case, "error", message=printable(outcome.trouble))
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def points_of(outcome: Outcome) -> float:
    """Return the points of one check: an equal share of the exercise's, or 1."""
    return outcome.points / len(outcome.results) if outcome.points else 1.0


def as_gradescope(outcomes: Sequence[Outcome]) -> str:
    """Return Gradescope's results.json: the course's points, or 1 per check; any trouble first."""
    tests = [
        {
            "name": f"{outcome.id} {result.id}: {result.title}",
            "score": points_of(outcome) * (result.status in (OK, NOTE)),
            "max_score": points_of(outcome),
            "output": "\n".join(line.strip() for line in lines_of(result)),
            "visibility": "visible",
        }
        for outcome in outcomes
        for result in outcome.results
    ]
    seconds = round(sum(outcome.seconds for outcome in outcomes), 1)
    remarks = [
        f"no verdict on exercise {outcome.id}, through no fault of yours: {outcome.trouble}"
        for outcome in outcomes
        if outcome.trouble
    ]
    output = {"output": "\n".join(remarks)} if remarks else {}
    return json.dumps({"tests": tests, "execution_time": seconds, **output}, indent=1)


def as_classroom(outcomes: Sequence[Outcome], environment: Mapping[str, str] = os.environ) -> str:
    """Return Classroom 50's result. environment: of the submission."""
    tests: list[dict[str, Any]] = [
        {
            "test-name": heading(outcome),
            "passed": outcome.passed,
            "score": (outcome.points or 1) * outcome.passed,
            "max-score": outcome.points or 1,
        }
        for outcome in outcomes
    ]
    given = [(field, environment.get(name)) for field, name in SUBMISSION.items()]
    about = {field: value for field, value in given if value}
    if "commit" in about:
        about.setdefault("review", about["commit"])
    score = {name: sum(test[name] for test in tests) for name in ("score", "max-score")}
    result = {"schema": "classroom50/result/v1", **about, **score, "tests": tests}
    return json.dumps(result, indent=1)


# {option: (what it writes, the function that makes it)}
FORMATS: dict[str, tuple[str, Callable[[Sequence[Outcome]], str]]] = {
    "json": ("all results", as_json),
    "junit": ("JUnit's XML", as_junit),
    "gradescope": ("Gradescope's results.json", as_gradescope),
    "classroom": ("Classroom 50's result", as_classroom),
}


def keep(folder: str | Path, name: str, outcomes: Sequence[Outcome]) -> None:
    """Write what was recorded of a workspace to FOLDER/NAME.json. Raises CannotCheck."""
    with contextlib.suppress(OSError):
        os.makedirs(folder, exist_ok=True)
    write(Path(folder, f"{name}.json"), as_json(outcomes))


def clear(path: str | Path) -> None:
    """Remove a file of an earlier check, but not, for example, a pipe. Raises CannotCheck."""
    if os.path.isfile(path) or os.path.isdir(path) or not os.path.exists(path):
        write(path, "")
        with contextlib.suppress(OSError):
            os.unlink(os.path.realpath(path))


def write(path: str | Path, text: str) -> None:
    """Write a file; names that are not UTF-8 are escaped. Raises CannotCheck."""
    try:
        with open(path, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
            file.write(text)
    except OSError as error:
        raise CannotCheck(f"{path}: {error.strerror}") from None
