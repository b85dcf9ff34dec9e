"""The suite's own courses: the worked example of COURSES.md, and the wiki's."""

import re
import shutil
import subprocess

import pytest

from tutorial_check.commands.self_test import patch
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

SQUARE, WIKI = REPOSITORY / "common/courses/square", REPOSITORY / "common/courses/wiki"


def check(*words):
    command = [REPOSITORY / "tutorial", "check", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=3600)
    return done.returncode, done.stdout + done.stderr


@claim(
    "The solutions of square and wiki come to what they should, and a self-test finds a check that "
    "passes everything"
)
@pytest.mark.night
@pytest.mark.parametrize(("name", "count"), [("square", 6), ("wiki", 86)])
def test_the_solutions_come_to_what_they_should(name, count):
    code, output = check("--course", name, "--self-test")
    assert code == 0, output
    assert output.count("\nok ") + output.startswith("ok ") == count, output


@claim(
    "A student of a course reads its words: mistakes in a service, a launch file and a transform, "
    "at their line; whose mistake a type is"
)
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


@claim("A student of a course ...", because="a program in C++")
def test_a_student_of_the_wiki_reads_line_and_cause_in_cpp(tmp_path):
    src = shutil.copytree(WIKI / "solutions/right_cpp", tmp_path / "ws" / "src")
    for name in ("W6_cpp_another_name", "W15_cpp_another_parent"):
        patch(src, WIKI / f"solutions/wrong_{name}.patch")
    code, output = check("--course", "wiki", "--in", tmp_path / "ws", "2", "7", "--hints", "2")
    places = re.findall(r"WRONG +(W\d+)|where: +(.*:\d+)", output)
    assert [*map("".join, places)] == [
        *("W6", "src/add_two_ints_server.cpp:18"),
        *("W15", "src/turtle_tf2_broadcaster.cpp:20"),
    ], output
    assert code == 1 and "advertiseService(...)" in output and "rospy" not in output, output


@claim("The solutions of square ...", because="the self-test")
def test_a_self_test_finds_a_check_that_passes_everything(tmp_path):
    course = shutil.copytree(SQUARE, tmp_path / "square")
    for solution in (course / "solutions").iterdir():
        if solution.stem not in ("right", "wrong_S2_turns_too_little"):
            subprocess.run(["rm", "-r", solution], check=True)
    checks = (course / "square.py").read_text().replace("NEAR_M = 0.1", "NEAR_M = 10.0")
    (course / "square.py").write_text(checks)
    code, output = check("--course", course, "--self-test")
    assert code == 1, output
    assert "FAILED wrong_S2_turns_too_little: S2 should be wrong, and nothing is" in output
