"""ros_results.py misses no failure that rosunit and rostest leave in their files."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "ros_results.py"
PASSED = '<testsuite errors="0" failures="0"><testcase name="a"/><testcase name="b"/></testsuite>'
SUITE = '<testsuite errors="{}" failures="{}"><testcase name="a">{}</testcase></testsuite>'.format
FAILED = (
    SUITE(0, 1, '<failure message="no"/>'),
    SUITE(1, 0, "<error>no</error>"),
    '<testsuite errors="0" failures="1"></testsuite>',  # of a subTest: counted, not named
    SUITE(0, 0, "<skipped/>"),  # without a reason
    "",  # of a test that was killed
)


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"rosunit-x": PASSED}, (0, "2 passed, 0 failed, 0 skipped")),
        # The file of a rostest repeats, and is not counted twice.
        ({"rosunit-x": PASSED, "rostest-x": PASSED}, (0, "2 passed, 0 failed, 0 skipped")),
        (
            {"rosunit-x": PASSED, "rosunit-y": SUITE(0, 0, '<skipped message="no screen"/>')},
            (0, "2 passed, 0 failed, 1 skipped"),
        ),
        ({}, (1, "0 passed, 0 failed, 0 skipped")),
        *(
            ({"rosunit-x": PASSED, "rostest-y": text}, (1, "2 passed, 1 failed, 0 skipped"))
            for text in FAILED
        ),
    ],
)
def test_the_last_line_and_the_exit_code(tmp_path, files, expected):
    for name, text in files.items():
        (tmp_path / f"{name}.xml").write_text(text)
    command = [sys.executable, str(SCRIPT), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stdout.splitlines()[-1]) == expected
