"""ros_results.py misses no failure that rosunit and rostest leave in their files."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "ros_results.py"
PASSED = '<testsuite errors="0" failures="0"><testcase name="a"/><testcase name="b"/></testsuite>'


def suite(note, errors=0, failures=0):
    """Return the file of one test case."""
    case = f'<testcase name="a">{note}</testcase>'
    return f'<testsuite errors="{errors}" failures="{failures}">{case}</testsuite>'


def outcome(tmp_path, **files):
    """Return (exit code, last line) for files NAME.xml."""
    for name, text in files.items():
        (tmp_path / "package").mkdir(exist_ok=True)
        (tmp_path / "package" / f"{name}.xml").write_text(text)
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path)],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    return done.returncode, done.stdout.splitlines()[-1]


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"rosunit-x": PASSED}, (0, "2 passed, 0 failed, 0 skipped")),
        # The file of a rostest repeats, and is not counted twice.
        ({"rosunit-x": PASSED, "rostest-x": '<testsuite><testcase name="x"/></testsuite>'},
         (0, "2 passed, 0 failed, 0 skipped")),
        ({"rosunit-x": PASSED, "rosunit-y": suite('<skipped message="no screen"/>')},
         (0, "2 passed, 0 failed, 1 skipped")),
        ({}, (1, "0 passed, 0 failed, 0 skipped")),
        *(({"rosunit-x": PASSED, "rostest-y": text}, (1, "2 passed, 1 failed, 0 skipped"))
          for text in (
              suite('<failure message="no"/>', failures=1),
              suite("<error>no</error>", errors=1),
              '<testsuite errors="0" failures="1"></testsuite>',  # of a subTest: counted, not named
              suite("<skipped/>"),  # without a reason
              "",  # of a test that was killed
          )),
    ],
)  # fmt: skip
def test_the_last_line_and_the_exit_code(tmp_path, files, expected):
    assert outcome(tmp_path, **files) == expected
