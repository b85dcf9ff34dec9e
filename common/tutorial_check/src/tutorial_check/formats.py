"""The report as files for other programs. Pure but for the writing."""

import contextlib
import json
import os
import xml.etree.ElementTree as ET
from dataclasses import replace

from tutorial_check.exercises import EXERCISES
from tutorial_check.model import NOTE, OK, UNREACHED, WRONG, CannotCheck
from tutorial_check.report import lines_of

FIELDS = ("id", "status", "title", "expected", "seen", "where", "hint")
# What Classroom 50 knows of a submission, in the environment of an autograder, by its name in the result.
# Without these it refuses the result; the owner and the times it writes itself (run_entrypoint,
# finalize_result and validate_result in runner.py of github.com/foundation50/classroom50).
SUBMISSION = {
    "classroom": "CLASSROOM",
    "assignment": "ASSIGNMENT",
    "submission": "SUBMISSION_TAG",
    "commit": "COMMIT_URL",
    "release": "RELEASE_URL",
    "review": "REVIEW_URL",
}


def without_hints(outcomes):
    """The same without a word on how to mend it."""
    return [
        replace(outcome, results=[replace(result, hint="") for result in outcome.results])
        for outcome in outcomes
    ]


def as_json(outcomes):
    """One object with all exercises and checks."""
    return json.dumps(
        {
            "exercises": [
                {
                    "id": outcome.id,
                    "passed": outcome.passed and not outcome.empty,
                    "nothing_to_check": outcome.empty,
                    "trouble": outcome.trouble,
                    "checks": [
                        {name: getattr(result, name) for name in FIELDS}
                        for result in outcome.results
                    ],
                }
                for outcome in outcomes
            ],
            "passed": sum(outcome.passed and not outcome.empty for outcome in outcomes),
            "total": len(outcomes),
        },
        indent=1,
    )


def as_junit(outcomes):
    """JUnit's XML: an exercise is a suite, a check a case; one more, if there is no verdict on it."""
    root = ET.Element("testsuites", name="tutorial check")
    for outcome in outcomes:
        suite = ET.SubElement(
            root,
            "testsuite",
            name=f"{outcome.id} {EXERCISES[outcome.id]}",
            tests=str(len(outcome.results) + bool(outcome.trouble)),
            time=f"{outcome.seconds:.2f}",
            failures=str(sum(result.status == WRONG for result in outcome.results)),
            skipped=str(sum(result.status == UNREACHED for result in outcome.results)),
            errors=str(int(bool(outcome.trouble))),
        )
        classname = f"exercise {outcome.id}"
        for result in outcome.results:
            case = ET.SubElement(
                suite,
                "testcase",
                classname=classname,
                name=f"{result.id} {result.title}",
            )
            text = _legal("\n".join(line.strip() for line in lines_of(result)[1:]))
            if result.status == WRONG:
                ET.SubElement(case, "failure", message=_legal(result.seen)).text = text
            elif result.status == UNREACHED:
                ET.SubElement(case, "skipped", message=_legal(result.seen))
            elif result.status == NOTE:
                ET.SubElement(case, "system-out").text = text
        if outcome.trouble:
            case = ET.SubElement(suite, "testcase", classname=classname, name="no verdict")
            ET.SubElement(case, "error", message=_legal(outcome.trouble))
    return ET.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _legal(text):
    """Without the characters that XML forbids; a program may print anything."""
    return "".join(
        each
        for each in text
        if each in "\n\t" or (ord(each) >= 0x20 and ord(each) not in (0xFFFE, 0xFFFF))
    )


def as_gradescope(outcomes):
    """Gradescope's results.json: one point a check; on top, on which exercises there is no verdict."""
    tests = [
        {
            "name": f"{outcome.id} {result.id}: {result.title}",
            "score": 1.0 if result.status in (OK, NOTE) else 0.0,
            "max_score": 1.0,
            "output": "\n".join(line.strip() for line in lines_of(result)),
            "visibility": "visible",
        }
        for outcome in outcomes
        for result in outcome.results
    ]
    told = {"tests": tests, "execution_time": round(sum(each.seconds for each in outcomes), 1)}
    troubles = [outcome for outcome in outcomes if outcome.trouble]
    if troubles:
        told["output"] = "\n".join(
            f"no verdict on exercise {one.id}, through no fault of yours: {one.trouble}"
            for one in troubles
        )
    return json.dumps(told, indent=1)


def as_classroom(outcomes, environment=os.environ):
    """Classroom 50's result: one point an exercise. environment: where it names the submission."""
    tests = [
        {
            "test-name": f"{outcome.id} {EXERCISES[outcome.id]}",
            "passed": outcome.passed,
            "score": int(outcome.passed),
            "max-score": 1,
        }
        for outcome in outcomes
    ]
    about = {
        field: environment[name] for field, name in SUBMISSION.items() if environment.get(name)
    }
    if "commit" in about:
        about.setdefault("review", about["commit"])
    return json.dumps(
        {
            "schema": "classroom50/result/v1",
            **about,
            "score": sum(outcome.passed for outcome in outcomes),
            "max-score": len(outcomes),
            "tests": tests,
        },
        indent=1,
    )


FORMATS = {
    "json": as_json,
    "junit": as_junit,
    "gradescope": as_gradescope,
    "classroom": as_classroom,
}


def clear(path):
    """Remove what was written there earlier, so that nobody takes it for today's. Raises CannotCheck.

    What is no file, as a pipe, is left alone; so is a place where files can be written, not removed.
    """
    if os.path.isfile(path) or os.path.isdir(path) or not os.path.exists(path):
        write(path, "")
        with contextlib.suppress(OSError):
            os.unlink(os.path.realpath(path))


def write(path, text):
    """Write a file; a name in it that is no UTF-8, as Python shows such a name. Raises CannotCheck."""
    try:
        with open(path, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
            file.write(text)
    except OSError as error:
        raise CannotCheck(f"{path}: {error.strerror}") from None
