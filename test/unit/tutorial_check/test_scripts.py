"""Why a program has failed, as far as a build is to blame."""

import pytest

from tutorial_check.scripts import cause_of
from tutorial_check.tracebacks import first_traceback

PACKAGE, SCRIPT = "joy2twist", "scripts/a.py"


@pytest.fixture
def session(make_session):
    """A session with a package, which has nothing to be built."""
    session = make_session(PACKAGE, "4.3")
    (session.package(PACKAGE).folder / "scripts").mkdir()
    return session


FAILED = """Traceback (most recent call last):
  File "{}/scripts/a.py", line 2, in <module>
    import axes
{}
"""


@pytest.mark.parametrize(
    ("error", "cmake", "exit_code", "is_said"),
    [
        ("ImportError: x", "catkin_python_setup()", 1, True),
        ("ModuleNotFoundError: No module named 'a'", "catkin_python_setup()", None, True),
        ("ImportError: x", "catkin_python_setup()", 0, False),
        ("ImportError: x", "catkin_package()", 1, False),
    ],
)
def test_an_import_may_want_what_is_not_built(session, error, cmake, exit_code, is_said):
    folder = session.package(PACKAGE).folder
    (folder / "CMakeLists.txt").write_text(cmake)
    (folder / SCRIPT).write_text("#!/usr/bin/env python3\nimport axes\n")
    session.memo("built", lambda: (exit_code, ""))
    trace = first_traceback(FAILED.format(folder, error), str(folder))
    place, hint = cause_of(session, PACKAGE, "a.py", trace)
    assert place == f"{SCRIPT}:2"
    assert ("catkin_make, which may have to make it, fails" in hint) == is_said
