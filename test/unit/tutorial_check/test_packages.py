"""From what catkin_make printed to the cause."""

from types import SimpleNamespace

import pytest

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
OF_CATKIN = """CMake Error at /usr/share/catkin/cmake/catkin_package_xml.cmake:54 (message):
  catkin_package_xml() package name 'beginner_tutorials' in
  '/ws/src/beginner_tutorials/package.xml' does not match current
  PROJECT_NAME 'beginner-tutorials'.  You must call project() with the same
  package name before.
Call Stack (most recent call first):
  /usr/share/catkin/cmake/catkin_package.cmake:99 (catkin_package_xml)
  beginner_tutorials/CMakeLists.txt:4 (catkin_package)
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

  Tried extensions .c .C .c++ .cc .cpp .cxx
"""
CUT_OFF = """CMake Error at beginner_tutorials/CMakeLists.txt:4:
  Parse error.  Function missing ending ")".  End of file reached.
"""
OF_ALL = """CMake Error at /usr/share/catkin/cmake/catkin_workspace.cmake:100 (message):
  This workspace contains non-catkin packages in it.
Call Stack (most recent call first):
  CMakeLists.txt:69 (catkin_workspace)
"""


@pytest.mark.parametrize(
    ("error", "seen", "where", "hint"),
    [
        (OF_CATKIN, "match current PROJECT_NAME 'beginner-tutorials'", 4, "into project()"),
        (NO_SCRIPT, "non-existing file '/ws/src/beginner_tutorials/scripts/taker.py'", 5, "path"),
        (NO_SOURCE, "CMake: Cannot find source file: src/talker.cpp", 5, "path"),
        (CUT_OFF, "CMake: Parse error. Function missing", 4, "read the first error"),
        (OF_ALL, "CMake: This workspace contains non-catkin packages in it.", None, ""),
    ],
    ids=["of catkin", "no script", "no source", "cut off", "of all"],
)
def test_an_error_of_cmakes(error, seen, where, hint):
    wrong = build_error(SimpleNamespace(packages=[]), BEFORE + error + AFTER)
    assert seen in wrong.seen
    assert wrong.where == (f"beginner_tutorials/CMakeLists.txt:{where}" if where else "")
    assert hint in wrong.hint
    assert "Call Stack" not in wrong.seen and "Configuring" not in wrong.seen


@pytest.mark.parametrize("output", ["", "all is well", BEFORE])
def test_no_error_of_cmakes(output):
    assert build_error(SimpleNamespace(packages=[]), output).where == ""
