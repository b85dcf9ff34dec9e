"""The files for other programs, and the text for people."""

import json
import xml.etree.ElementTree as ET

from tutorial_check.examination import Outcome
from tutorial_check.formats import as_classroom, as_gradescope, as_json, as_junit
from tutorial_check.model import NOTE, OK, UNREACHED, WRONG, Result
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


def test_an_exercise_that_was_cut_off_is_not_done():
    assert summary([GOOD, CUT_OFF]) == "1 of 2 exercises done"


def test_text():
    text = text_of([BAD])
    for word in (
        "expected: a < b",
        "where:    f.py:3",
        "hint:     do it",
        "handout 4.3; see it yourself: rostopic echo",
    ):
        assert word in text
    assert "hint:" not in text_of([BAD], hints=False)
