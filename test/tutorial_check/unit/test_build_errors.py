"""Errors in catkin_make's output that no stored row shows."""

import time

import pytest

from tutorial_check.checking.build_errors import build_error, endless_build
from tutorial_testing.claims import claim

TALKER = "project(mine)\nadd_executable(talker src/talker.cpp)\n"
SAME_NAME = """\
CMake Error at {}/CMakeLists.txt:2 (add_executable):
  add_executable cannot create target "talker" because another target with
  the same name already exists.  The existing target is an executable created
  in source directory "@/mine".  See documentation
  for policy CMP0002 for more details.


"""


@pytest.fixture
def session(make_submission):
    session = make_submission("mine", "2")
    files = {"mine/CMakeLists.txt": TALKER, "mine/src/talker.cpp": "", "mine/src/chat.cc": ""}
    for path, text in files.items():
        (session.source / path).parent.mkdir(exist_ok=True)
        (session.source / path).write_text(text)
    return session


def test_an_error_in_a_header_of_the_system_is_blamed_on_the_line_that_includes_it(session):
    output = f"""\
In file included from {session.source}/mine/src/use.cpp:3:
/usr/include/ros/param.h:7:1: error: no match
"""
    assert build_error(session, output).where == "mine/src/use.cpp:3"
    foreign = output.replace(str(session.source), "/a")
    assert build_error(session, foreign).where == "/usr/include/ros/param.h:7"


@pytest.mark.parametrize(
    "text", ["/a", "*** [/CMakeFiles/a.dir", "undefined reference to ", "a", "\n from /a:1:"]
)
def test_an_output_of_any_text_is_read_at_once(text, session):
    began_s = time.process_time()
    build_error(session, f"{text * 199_999}\n/a.c:1:1: error: no")
    assert time.process_time() - began_s < 20.0


@claim("Two targets of a name, also in two packages, are reported with both places")
def test_two_targets_of_a_name_are_reported_with_both_places(session):
    output = SAME_NAME.replace("@", str(session.source))
    wrong = build_error(session, output.format("other"))
    assert wrong.where == "other/CMakeLists.txt:2"
    assert wrong.seen == "two targets are named talker: this one, and mine/CMakeLists.txt:2"
    assert "name it ${PROJECT_NAME}_talker in each line" in wrong.hint
    assert "PROPERTIES OUTPUT_NAME talker)" in wrong.hint
    wrong = build_error(session, output.format("mine"))
    assert wrong.hint == "each program and library has a name of its own: talker is there already"


@claim("An error of CMake about a program in C++ names its line and the usual cause")
@pytest.mark.parametrize(("message", "line", "words"), [
    (" at mine/CMakeLists.txt:2 (add_executable):\n  Cannot find source file:\n\n    src/taker.cpp"
     "\n\n  Tried extensions .c .C", 2, "is src/talker.cpp meant?"),
    (" at mine/CMakeLists.txt:2 (add_executable):\n  Cannot find source file:\n\n    chat.cpp\n\n"
     "  Tried extensions .c .C", 2, "is src/chat.cc meant?"),
    (" at mine/CMakeLists.txt:2 (add_executable):\n  Cannot find source file:\n\n    src/other.cpp",
     2, "look at the spelling of the file's path"),
    (" at mine/CMakeLists.txt:2 (add_executable):\n  No SOURCES given to target: talker", 2,
     "and then its files"),
    (': Cannot determine link language for target "talker".\nCMake Error: CMake can not determine '
     "linker language for target: talker\n-- Generating done", 2, "catkin_install_python"),
    (' at mine/CMakeLists.txt:3:\n  Parse error.  Function missing ending ")".  End of file '
     "reached.", 3, "a ( is opened there and never closed"),
    (" at mine/CMakeLists.txt:3 (target_link_libraries):\n  Cannot specify link libraries for "
     'target "talk" which is not built by\n  this project.', 3, "add_executable(talk ...)"),
    (" at mine/CMakeLists.txt:9 (target_link_libraries):\n  The keyword signature for "
     "target_link_libraries has already been used with", 9, "or in none"),
    (' at mine/CMakeLists.txt:2 (add_executable):\n  The target name "test" is reserved when CTest '
     "testing is enabled.", 2, "another name, as ${PROJECT_NAME}_node"),
])  # fmt: skip
def test_an_error_of_cmake_about_a_program_in_cpp_has_its_line_and_cause(
    message, line, words, session
):
    wrong = build_error(session, f"CMake Error{message}\n\n\n-- Configuring incomplete\n")
    assert wrong.where == f"mine/CMakeLists.txt:{line}"
    assert words in wrong.hint
    assert wrong.seen.startswith("CMake: ")
    assert "Tried" not in wrong.seen and "Generating" not in wrong.seen


@claim("A build that does not end is reported with what it is compiling, or CMake's command")
@pytest.mark.parametrize(("output", "where", "words"), [
    ("-- ==> add_subdirectory(mine)\n[ 50%] Building CXX object "
     "mine/CMakeFiles/talker.dir/src/talker.cpp.o\n", "mine/src/talker.cpp", "which template"),
    ("-- ==> add_subdirectory(mine)\n", "mine/CMakeLists.txt:3", "which command of CMakeLists.txt"),
    ("[ 50%] Building CXX object mine/CMakeFiles/talker.dir/src/talker.cpp.o\n[100%] Built target "
     "talker\n", "mine/CMakeLists.txt:3", "which command of CMakeLists.txt"),
    ("Base path: /ws\n", "mine/CMakeLists.txt:3", "which command of CMakeLists.txt"),
])  # fmt: skip
def test_a_build_that_does_not_end_has_its_last_step(output, where, words, session):
    cmake = f"{TALKER}execute_process(COMMAND sleep 1000)\n"
    (session.source / "mine/CMakeLists.txt").write_text(cmake)
    wrong = endless_build(session, output)
    assert (wrong.where, "two minutes" in wrong.seen) == (where, True)
    assert words in wrong.hint


def test_a_file_outside_that_cmake_includes_is_not_quoted(session):
    cmake = f"{TALKER}include(/etc/passwd)\n"
    (session.source / "mine/CMakeLists.txt").write_text(cmake)
    output = (
        "CMake Error at /etc/passwd:1:\n  Parse error.  Expected a command name, got unquoted "
        'argument with text\n  "root:x:0:0:root:/root:/bin/bash".\nCall Stack (most recent call '
        "first):\n  mine/CMakeLists.txt:3 (include)\n\n\n-- Configuring incomplete\n"
    )
    wrong = build_error(session, output)
    assert (wrong.seen, wrong.where) == ("CMake includes /etc/passwd", "mine/CMakeLists.txt:3")
    assert "root" not in f"{vars(wrong)}"


def test_a_command_of_make_that_fails_is_reported_with_its_target(session):
    line = "make[2]: *** [mine/CMakeFiles/talker.dir/build.make:76: mine/x.cpp] Error 1"
    wrong = build_error(session, f'{line}\nmake: *** [all] Error 2\nInvoking "make -j2" failed\n')
    assert (wrong.seen, wrong.where) == (line, "mine/CMakeLists.txt:2")
