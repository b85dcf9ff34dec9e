"""ros_results.py misses no failure that rosunit and rostest leave in their files."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "ros_results.py"
PASSED = '<testsuite errors="0" failures="0"><testcase name="a"/><testcase name="b"/></testsuite>'


def told(tmp_path, **files):
    """(exit code, last line) for files NAME.xml."""
    for name, text in files.items():
        (tmp_path / "package").mkdir(exist_ok=True)
        (tmp_path / "package" / f"{name}.xml").write_text(text)
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path)],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    return done.returncode, done.stdout.splitlines()[-1]


def test_all_passed(tmp_path):
    assert told(tmp_path, **{"rosunit-x": PASSED}) == (0, "2 passed, 0 failed, 0 skipped")


def test_the_file_of_a_rostest_repeats_and_is_not_counted_twice(tmp_path):
    files = {"rosunit-x": PASSED, "rostest-x": '<testsuite><testcase name="x"/></testsuite>'}
    assert told(tmp_path, **files) == (0, "2 passed, 0 failed, 0 skipped")


@pytest.mark.parametrize(
    "suite",
    [
        '<testsuite failures="1"><testcase name="a"><failure message="no"/></testcase></testsuite>',
        '<testsuite errors="1"><testcase name="a"><error>no</error></testcase></testsuite>',
        '<testsuite errors="0" failures="1"></testsuite>',  # of a subTest: counted, not named
        '<testsuite><testcase name="a"><skipped/></testcase></testsuite>',  # without a reason
        "",  # of a test that was ended from outside
    ],
)
def test_a_failure_in_any_form_fails(tmp_path, suite):
    code, line = told(tmp_path, **{"rosunit-x": PASSED, "rostest-y": suite})
    assert (code, line) == (1, "2 passed, 1 failed, 0 skipped")


def test_a_skip_with_a_reason_is_told(tmp_path):
    suite = '<testsuite><testcase name="a"><skipped message="no screen"/></testcase></testsuite>'
    line = "2 passed, 0 failed, 1 skipped"
    assert told(tmp_path, **{"rosunit-x": PASSED, "rosunit-y": suite}) == (0, line)


def test_no_result_at_all_fails(tmp_path):
    assert told(tmp_path) == (1, "0 passed, 0 failed, 0 skipped")
