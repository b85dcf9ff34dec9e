"""What is said where a build is needed and fails."""

import pytest

from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.exercises.files import cause_of
from tutorial_check.tracebacks import first_traceback

TRACEBACK = """Traceback (most recent call last):
  File "{}/scripts/joy2twist.py", line 2, in <module>
    import axes
{}
"""


@pytest.mark.parametrize(
    "error", ["ImportError: of it", "ModuleNotFoundError: No module named 'a'"]
)
@pytest.mark.parametrize(
    ("cmake", "exit_code", "is_said"),
    [
        ("catkin_python_setup()", 1, True),
        ("catkin_python_setup()", None, True),
        ("catkin_python_setup()", 0, False),
        ("catkin_package()", 1, False),
    ],
)
def test_an_import_may_want_what_is_not_built(make_session, error, cmake, exit_code, is_said):
    session = make_session(PACKAGE, "4.3")
    folder = session.package(PACKAGE).folder
    (folder / "scripts").mkdir()
    (folder / "CMakeLists.txt").write_text(cmake)
    (folder / "scripts/joy2twist.py").write_text("#!/usr/bin/python3\nimport axes\n")
    session.memo("built", lambda: (exit_code, ""))
    trace = first_traceback(TRACEBACK.format(folder, error), str(folder))
    place, hint = cause_of(session, PACKAGE, "joy2twist.py", trace)
    assert place == "scripts/joy2twist.py:2"
    assert ("catkin_make, which may have to make it, fails" in hint) == is_said
