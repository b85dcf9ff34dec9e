"""What can be said of a program before it is run."""

import contextlib

import pytest

from tutorial_check.model import Wrong
from tutorial_check.scripts import cause_of, check_file
from tutorial_check.tracebacks import first_traceback

FIRST = "#!/usr/bin/env python3\n"
PACKAGE, SCRIPT = "joy2twist", "scripts/a.py"


@pytest.fixture
def session(make_session):
    """A session with a package, which has nothing to be built."""
    session = make_session(PACKAGE, "4.3")
    (session.package(PACKAGE).folder / "scripts").mkdir()
    return session


def write(session, text, mode=0o755):
    """Put a program in the package."""
    path = session.package(PACKAGE).folder / SCRIPT
    path.write_bytes(text.encode())
    path.chmod(mode)


@pytest.mark.parametrize(
    ("first", "is_one"),
    [
        ("/usr/bin/env -S python3 -u", True),
        ("/usr/bin/env -S PYTHONUNBUFFERED=1 python3", True),
        ("/usr/bin/env python", True),
        ("/usr/bin/python3 -u", True),
        ("/usr/bin/env -S pythn3 -u", False),
        ("/usr/bin/env -S", False),
        ("/bin/sh", False),
    ],
)
def test_interpreters(session, first, is_one):
    write(session, f"#!{first}\n")
    refused = pytest.raises(Wrong, match="an interpreter that exists")
    with contextlib.nullcontext() if is_one else refused:
        check_file(session, PACKAGE, SCRIPT)


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
    write(session, f"{FIRST}import axes\n")
    session.memo("built", lambda: (exit_code, ""))
    trace = first_traceback(FAILED.format(folder, error), str(folder))
    place, hint = cause_of(session, PACKAGE, "a.py", trace)
    assert place == f"{SCRIPT}:2"
    assert ("catkin_make, which may have to make it, fails" in hint) == is_said
