"""The files for other programs, and the text for people."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from tutorial_check.examination import Outcome
from tutorial_check.formats import (
    FORMATS,
    as_classroom,
    as_gradescope,
    as_json,
    as_junit,
    without_hints,
)
from tutorial_check.model import NOTE, OK, UNREACHED, WRONG, Result
from tutorial_check.professor import Student, table_csv, table_html
from tutorial_check.report import summary, text_of

GOOD = Outcome("2", [Result("C1", OK, "one"), Result("C2", NOTE, "two", seen="odd")], 1.0, True)
BAD = Outcome(
    "4.3",
    [
        Result(
            "C16",
            WRONG,
            "three",
            "a < b",
            "c\x00\x1b & d",
            "f.py:3",
            "do it",
            "4.3",
            "rostopic echo",
        ),
        Result("C17", UNREACHED, "four", seen="first mend C16"),
    ],
    2.0,
    True,
)
NO_VERDICT = Outcome("5", [Result("C21", UNREACHED, "five")], 1.0, True, "C21: no\x1b room")
CUT_OFF = Outcome("5", [Result("C21", OK, "five")], 0.0, False)


def test_json():
    told = json.loads(as_json([GOOD, BAD]))
    assert (told["passed"], told["total"]) == (1, 2)
    assert [each["passed"] for each in told["exercises"]] == [True, False]
    assert told["exercises"][1]["checks"][0] == {
        "id": "C16",
        "status": "wrong",
        "title": "three",
        "expected": "a < b",
        "seen": "c\x00\x1b & d",
        "where": "f.py:3",
        "hint": "do it",
    }


def test_junit_is_xml_whatever_was_printed():
    root = ET.fromstring(as_junit([GOOD, BAD]))
    assert [suite.get("failures") for suite in root] == ["0", "1"]
    assert root.find(".//failure").get("message") == "c & d"
    assert len(root.findall(".//skipped")) == 1


def test_gradescope():
    tests = json.loads(as_gradescope([GOOD, BAD]))["tests"]
    assert [test["score"] for test in tests] == [1.0, 1.0, 0.0, 0.0]
    assert all(
        set(test) == {"name", "score", "max_score", "output", "visibility"} for test in tests
    )


def test_classroom():
    told = json.loads(as_classroom([GOOD, BAD]))
    assert (told["schema"], told["score"], told["max-score"]) == ("classroom50/result/v1", 1, 2)
    assert [test["passed"] for test in told["tests"]] == [True, False]


def test_classroom_50_is_told_which_submission_it_is():
    """All that its runner demands of a result and does not write itself."""
    given = {
        "CLASSROOM": "ros",
        "ASSIGNMENT": "joy",
        "SUBMISSION_TAG": "submit/1",
        "COMMIT_URL": "https://git.example/c",
        "RELEASE_URL": "https://git.example/r",
    }
    told = json.loads(as_classroom([GOOD], given))
    assert [told[name] for name in ("classroom", "assignment", "submission")] == [
        "ros",
        "joy",
        "submit/1",
    ]
    assert (told["commit"], told["release"]) == (given["COMMIT_URL"], given["RELEASE_URL"])
    assert told["review"] == given["COMMIT_URL"]
    told = json.loads(as_classroom([GOOD], {**given, "REVIEW_URL": "https://git.example/v"}))
    assert told["review"] == "https://git.example/v"
    assert set(json.loads(as_classroom([GOOD], {}))) == {"schema", "score", "max-score", "tests"}


def test_no_verdict_is_an_error_and_no_fault_of_the_students():
    suite = ET.fromstring(as_junit([GOOD, NO_VERDICT]))[1]
    assert (suite.get("errors"), suite.get("tests"), len(suite)) == ("1", "2", 2)
    assert suite.find(".//error").get("message") == "C21: no room"
    assert ET.fromstring(as_junit([GOOD]))[0].get("errors") == "0"
    told = json.loads(as_json([GOOD, NO_VERDICT]))
    assert [each["trouble"] for each in told["exercises"]] == ["", NO_VERDICT.trouble]
    output = json.loads(as_gradescope([GOOD, NO_VERDICT]))["output"]
    assert "no verdict on exercise 5, through no fault of yours: C21: no" in output
    assert "output" not in json.loads(as_gradescope([GOOD, BAD]))


@pytest.mark.parametrize("make", [*FORMATS.values(), text_of])
def test_without_hints(make):
    assert "do it" not in make(without_hints([BAD]))
    assert BAD.results[0].hint == "do it"


def test_an_exercise_that_was_cut_off_is_not_done():
    assert summary([GOOD, CUT_OFF]) == "1 of 2 exercises done"


def test_an_exercise_with_nothing_to_check_is_not_done():
    note = Result("C11", "note", "a recording", seen="no bag", empty=True)
    empty = Outcome("4.2", [note], done=True)
    assert summary([GOOD, empty]) == "1 of 2 exercises done (4.2: nothing to check)"
    told = json.loads(as_json([GOOD, empty]))
    assert (told["passed"], told["total"]) == (1, 2)
    words = [(each["passed"], each["nothing_to_check"]) for each in told["exercises"]]
    assert words == [(True, False), (False, True)]
    students = [Student("ann", Path("ann"), [GOOD, empty])]
    cells = table_csv(students, [GOOD.id, "4.2"]).splitlines()[1].split(",")
    assert cells[1:4] == ["ok", "not done", "1"]
    assert ">not done<" in table_html(students, [GOOD.id, "4.2"])


def test_text():
    text = text_of([BAD])
    for word in (
        "expected: a < b",
        "where:    f.py:3",
        "hint:     do it",
        "handout 4.3; see it yourself: rostopic echo",
    ):
        assert word in text
