"""Files for other programs, and the last line for people."""

import json
import xml.etree.ElementTree as ET

import pytest

from tutorial_check.checking.results import NOTE, OK, UNREACHED, WRONG, Outcome, Result
from tutorial_check.report.formats import as_classroom, as_gradescope, as_json, as_junit
from tutorial_check.report.text import summary
from tutorial_testing.claims import claim

pytestmark = claim(
    "JSON, JUnit, Gradescope and Classroom 50 get what they want, and why there is no verdict"
)
NAMES = ("id", "status", "title", "expected", "seen", "where", "hint")
VALUES = ("C16", WRONG, "three", "a < b", "c\x00\x1b & d", "f.py:3", "do it")
ABOUT = {"section": "handout 4.3", "look": "rostopic echo"}
GOOD = Outcome("2", [Result("C1", OK, "one"), Result("C2", NOTE, "two", seen="odd")], 1.0, True)
STOPPED = Result("C17", UNREACHED, "four", seen="first fix C16")
BAD = Outcome("4.3", [Result(*VALUES, **ABOUT), STOPPED], 2.0, True, title="joy2twist")
NO_VERDICT = Outcome("5", [Result("C21", UNREACHED, "five")], 1.0, True, "C21: no\x1b space")
CUT_OFF = Outcome("5", [Result("C21", OK, "five")], 0.0, False)
EMPTY = Outcome("4.2", [Result("C11", NOTE, "a recording", seen="no bag", empty=True)], done=True)
URLS = {f"{name}_URL": f"https://git.example/{name}" for name in ("COMMIT", "RELEASE")}
GIVEN = {"CLASSROOM": "ros", "ASSIGNMENT": "joy", "SUBMISSION_TAG": "submit/1", **URLS}


def test_the_points_of_a_course():
    two = Outcome("1", [Result("S1", OK, "a"), Result("S2", WRONG, "b")], done=True, points=3.0)
    tests = json.loads(as_gradescope([two]))["tests"]
    assert [(test["score"], test["max_score"]) for test in tests] == [(1.5, 1.5), (0.0, 1.5)]
    found = json.loads(as_classroom([two, GOOD], {}))
    assert (found["score"], found["max-score"]) == (1, 4.0)


def test_json_has_each_check_and_why_there_is_no_verdict():
    found = json.loads(as_json([GOOD, BAD, NO_VERDICT, EMPTY]))
    assert (found["passed"], found["total"]) == (1, 4)
    assert [exercise["passed"] for exercise in found["exercises"]] == [True, False, False, False]
    assert [e["trouble"] for e in found["exercises"]] == [
        "",
        "",
        NO_VERDICT.trouble,
        "",
    ]
    assert [e["nothing_to_check"] for e in found["exercises"]] == [False] * 3 + [True]
    assert found["exercises"][1]["checks"][0] == dict(zip(NAMES, VALUES))


def test_junit_is_xml_whatever_was_printed():
    root = ET.fromstring(as_junit([GOOD, BAD, NO_VERDICT]))
    counts = [[suite.get(name) for name in ("tests", "failures", "errors")] for suite in root]
    assert counts == [["2", "0", "0"], ["2", "1", "0"], ["2", "0", "1"]]
    assert root.find(".//failure").get("message") == "c & d"
    assert root.find(".//error").get("message") == "C21: no space"
    assert [len(root.findall(f".//{tag}")) for tag in ("skipped", "system-out")] == [2, 1]


def test_gradescope_has_a_point_a_check():
    found = json.loads(as_gradescope([GOOD, BAD]))
    assert [test["score"] for test in found["tests"]] == [1.0, 1.0, 0.0, 0.0]
    assert set(found["tests"][0]) == {"name", "score", "max_score", "output", "visibility"}
    assert "output" not in found
    output = json.loads(as_gradescope([GOOD, NO_VERDICT]))["output"]
    assert "no verdict on exercise 5, through no fault of yours: C21: no" in output


def test_classroom_50_learns_which_submission_it_is():
    """It has all that the runner requires in a result and does not write itself."""
    found = json.loads(as_classroom([GOOD, BAD], GIVEN))
    tests = found.pop("tests")
    assert [test["passed"] for test in tests] == [True, False]
    about = {"classroom": "ros", "assignment": "joy", "submission": "submit/1"}
    about["commit"] = about["review"] = GIVEN["COMMIT_URL"]
    score = {"schema": "classroom50/result/v1", "score": 1, "max-score": 2}
    assert found == {**about, **score, "release": GIVEN["RELEASE_URL"]}
    reviewed = {**GIVEN, "REVIEW_URL": "https://git.example/v"}
    assert json.loads(as_classroom([GOOD], reviewed))["review"] == "https://git.example/v"
    assert set(json.loads(as_classroom([GOOD], {}))) == {*score, "tests"}


@pytest.mark.parametrize(("other", "rest"), [(CUT_OFF, ""), (EMPTY, " (4.2: nothing to check)")])
def test_what_was_cut_off_or_is_empty_is_not_done(other, rest):
    assert summary([GOOD, other]) == f"1 of 2 exercises done{rest}"
