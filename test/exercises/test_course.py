"""A course of one's own: the worked example of COURSES.md, as the page says."""

import shutil
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SQUARE = REPOSITORY / "common/doc/square"


def check(*words):
    """Return (exit code, output) of ./tutorial check."""
    command = [REPOSITORY / "tutorial", "check", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.night
def test_the_squares_solutions_come_to_what_they_should():
    code, output = check("--course", SQUARE, "--self-test")
    assert code == 0, output
    assert output.count("\nok ") + output.startswith("ok ") == 5, output


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


def test_a_student_of_a_course_reads_its_words(tmp_path):
    src = tmp_path / "ws" / "src"
    shutil.copytree(SQUARE / "solutions/right", src)
    script = src / "square/scripts/square.py"
    script.write_text(script.read_text().replace("rospy.init_node", "rospy.initnode"))
    code, output = check("--course", SQUARE, "--in", tmp_path / "ws")
    assert code == 1
    assert "1 a square of 1 m\n  WRONG  S1  it drives" in output, output
    assert "where:    scripts/square.py:" in output and "task sheet 1" in output
    code, output = check("--course", SQUARE, "--in", tmp_path / "ws", "4.3")
    assert (code, "no exercise 4.3; there are 1" in output) == (2, True), output
