"""Courses that come with the suite: the worked example of COURSES.md, as the page says; the wiki's."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tutorial_check.self_test import patch

REPOSITORY = Path(__file__).resolve().parents[2]
SQUARE, WIKI = REPOSITORY / "common/doc/square", REPOSITORY / "common/doc/wiki"
OF_A_CLIENT = """
from dataclasses import dataclass
from tutorial_check.course import check
from tutorial_check.course_kit.client import Answer, Client, Transform
@dataclass(frozen=True)
class Seen:
    answer: Answer
def ask(ground, kind, value) -> Seen:
    with ground.stage() as stage:
        return Seen(Client(stage).ask("/own", kind, {"a": value}))
def asks(number, *about):
    @check(f"S{number}", "a", "1")
    def a(session):
        return session.recording(ask, *about).answer.trouble
asks(1, "no_msgs/None", 1)
asks(2, "beginner_tutorials/None", 1)
asks(3, "beginner_tutorials/AddTwoInts", "x")
asks(4, "beginner_tutorials/AddTwoInts", 1)
"""


def check(*words):
    """Return (exit code, output) of ./tutorial check."""
    command = [REPOSITORY / "tutorial", "check", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=3600)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.night
@pytest.mark.parametrize(("name", "count"), [("square", 5), ("wiki", 69)])
def test_the_solutions_come_to_what_they_should(name, count):
    code, output = check("--course", name, "--self-test")
    assert code == 0, output
    assert output.count("\nok ") + output.startswith("ok ") == count, output


def test_a_student_of_the_wiki_reads_line_and_cause(tmp_path):
    src = shutil.copytree(WIKI / "solutions/right", tmp_path / "ws" / "src")
    for name in ("W6_another_field", "W9_swapped", "W15_another_parent"):
        patch(src, WIKI / f"solutions/wrong_{name}.patch")
    code, output = check("--course", "wiki", "--in", tmp_path / "ws", "2", "3", "4", "7")
    places = re.findall(r"WRONG +(W\d+)|where: +(.*:\d+)", output)
    assert [*map("".join, places)] == [
        *("W6", "scripts/add_two_ints_server.py:9"),
        *("W9", "launch/turtlemimic.launch:9"),
        *("W15", "nodes/turtle_tf2_broadcaster.py:15"),
    ], output
    assert code == 1 and "ok     W8" in output, output
    assert "exercise 2; see it yourself: rosservice call /add_two_ints 1 2" in output
    code, output = check("--course", "wiki", "--in", tmp_path / "ws", "9")
    assert (code, "no exercise 9; there are 1, 2" in output) == (2, True), output


def test_whose_mistake_a_type_is(tmp_path):
    (tmp_path / "course.yaml").write_text("exercises: {'1': a}\n")
    (tmp_path / "asks.py").write_text(OF_A_CLIENT)
    _, output = check("--course", tmp_path, "--in", WIKI / "solutions/right")
    for line in (
        "could not be checked: asks.py:10: there is no type no_msgs/None",
        "seen:     there is no type beginner_tutorials/None",
        "seen:     beginner_tutorials/AddTwoIntsRequest: {'a': 'x'} does not fit",
        "ok     S4  a  (there is no service /own; there are: none)",
    ):
        assert line in output, output


def test_a_self_test_finds_a_check_that_passes_everything(tmp_path):
    course = shutil.copytree(SQUARE, tmp_path / "square")
    for solution in (course / "solutions").iterdir():
        if solution.name not in ("right", "wrong_S2_turns_too_little"):
            shutil.rmtree(solution)
    checks = (course / "square.py").read_text().replace("NEAR_M = 0.1", "NEAR_M = 10.0")
    (course / "square.py").write_text(checks)
    code, output = check("--course", course, "--self-test")
    assert code == 1, output
    assert "FAILED wrong_S2_turns_too_little: S2 should be wrong, and nothing is" in output
