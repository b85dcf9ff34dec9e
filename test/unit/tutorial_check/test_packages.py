"""From what catkin_make printed to the cause."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises import packages
from tutorial_check.exercises.packages import _build_error as build_error
from tutorial_check.model import Wrong

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
        (OF_ALL, "CMake: This workspace contains non-catkin packages in it.", None, ""),
    ],
    ids=["of catkin", "no script", "no source", "of all"],
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


@pytest.mark.parametrize(
    "words", ["rospy", "rospy joy2twist", "rospy # joystick", "${NEEDED}", "rospy roscpp"]
)
def test_components_that_can_be_found(joy2twist, words):
    assert joy2twist(f"find_package(catkin REQUIRED COMPONENTS\n  {words}\n)\n") == "src/joy2twist"
    assert joy2twist("find_package(catkin REQUIRED)") == "src/joy2twist"


def test_a_component_that_cannot_be_found(joy2twist):
    with pytest.raises(Wrong, match="catkin cannot find joystick") as raised:
        joy2twist(
            "project(joy2twist)\nfind_package(catkin REQUIRED COMPONENTS\n  rospy joystick)\n"
        )
    assert raised.value.where == "joy2twist/CMakeLists.txt:3"


def dependencies(session, *lines):
    """What is wrong with the dependencies of beginner_tutorials, std_msgs and these."""
    folder = session.package("beginner_tutorials").folder
    about = "<name>beginner_tutorials</name><version>0.0.0</version><description>x</description>"
    about += "<maintainer email='s@u.example'>s</maintainer><license>x</license>"
    depends = "\n".join(f"<{line}" for line in lines)
    (folder / "package.xml").write_text(f"<package format='2'>{about}\n{depends}\n</package>")
    session._memory.clear()
    with pytest.raises(Wrong) as raised:
        packages.beginner_dependencies(session)
    return raised.value


def test_all_dependencies_that_are_missing_are_named(make_session):
    wrong = dependencies(make_session("beginner_tutorials", "2"), "depend>std_msgs</depend>")
    assert wrong.hint == "add <depend>rospy</depend> and <depend>roscpp</depend>"


def test_a_dependency_that_is_misspelt_in_one_of_its_kinds(make_session):
    lines = [f"depend>{each}</depend>" for each in ("rospy", "roscpp")]
    lines += ["build_depend>std_msg</build_depend>", "exec_depend>std_msgs</exec_depend>"]
    wrong = dependencies(make_session("beginner_tutorials", "2"), *lines)
    assert wrong.seen == "std_msg, which is no package"
    assert wrong.where.endswith("package.xml:4")
