"""From what catkin_make printed to the cause."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises import packages
from tutorial_check.exercises.packages import _build_error as build_error

BEFORE = """-- ==> add_subdirectory(joy2twist)
CMake Deprecation Warning at joy2twist/CMakeLists.txt:1 (cmake_minimum_required):
  Compatibility with CMake < 2.8.12 will be removed from a future version of
  CMake.


"""
AFTER = """

-- Configuring incomplete, errors occurred!
Invoking "cmake" failed
"""
NO_SCRIPT = """\x1b[31mCMake Error at /usr/share/catkin/cmake/install_python.cmake:86 (message):
  catkin_install_python() called with non-existing file
  '/ws/src/beginner_tutorials/scripts/taker.py'.
Call Stack (most recent call first):
  beginner_tutorials/CMakeLists.txt:5 (catkin_install_python)
\x1b[0m"""
NO_SOURCE = """CMake Error at beginner_tutorials/CMakeLists.txt:5 (add_executable):
  Cannot find source file:

    src/talker.cpp
"""
OF_ALL = """CMake Error at /usr/share/catkin/cmake/catkin_workspace.cmake:100 (message):
  This workspace contains non-catkin packages in it.
Call Stack (most recent call first):
  CMakeLists.txt:69 (catkin_workspace)
"""


@pytest.mark.parametrize(
    ("error", "seen", "where", "hint"),
    [
        (NO_SCRIPT, "non-existing file '/ws/src/beginner_tutorials/scripts/taker.py'", 5, "path"),
        (NO_SOURCE, "CMake: Cannot find source file: src/talker.cpp", 5, "path"),
        (OF_ALL, "CMake: This workspace contains non-catkin packages in it.", None, ""),
    ],
)
def test_an_error_of_cmakes(error, seen, where, hint):
    wrong = build_error(SimpleNamespace(packages=[]), BEFORE + error + AFTER)
    assert seen in wrong.seen
    assert wrong.where == (f"beginner_tutorials/CMakeLists.txt:{where}" if where else "")
    assert hint in wrong.hint
    assert "Call Stack" not in wrong.seen and "Configuring" not in wrong.seen


@pytest.fixture
def joy2twist(make_session, monkeypatch):
    """C12 of a package with this CMakeLists.txt, all of whose dependencies are declared."""
    session = make_session("joy2twist", "4.3")
    folder = session.package("joy2twist").folder
    monkeypatch.setattr(packages, "_dependencies", lambda *_: session.package("joy2twist"))
    (session.folder / "share/rospy/cmake").mkdir(parents=True)
    (session.folder / "share/rospy/cmake/rospyConfig.cmake").touch()
    session.underlay_environment["CMAKE_PREFIX_PATH"] = str(session.folder)
    session.memo("built", lambda: (1, 'Could not find a package "joystick"\n'))

    def check(text):
        (folder / "CMakeLists.txt").write_text(text)
        return packages.joy2twist(session)

    return check


@pytest.mark.parametrize("words", ["rospy joy2twist", "rospy # joystick", "${NEEDED}"])
def test_components_that_can_be_found(joy2twist, words):
    assert joy2twist(f"find_package(catkin REQUIRED COMPONENTS\n  {words}\n)\n") == "src/joy2twist"
    assert joy2twist("find_package(catkin REQUIRED)") == "src/joy2twist"
