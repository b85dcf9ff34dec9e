"""From what the linker printed to the line of CMakeLists.txt, or of the source, and the cause."""

import pytest

from tutorial_check.checking.build_errors import build_error
from tutorial_testing.claims import claim

LINKED = "target_link_libraries(${PROJECT_NAME}_talker ${catkin_LIBRARIES})\n"
CMAKE = (
    "project(mine)\nfind_package(catkin REQUIRED COMPONENTS roscpp)\n"
    "add_executable(${PROJECT_NAME}_talker src/talker.cpp)\n"
)
FAILED = (
    "make[2]: *** [mine/CMakeFiles/mine_talker.dir/build.make:97: "
    "/ws/devel/lib/mine/mine_talker] Error 1\n"
)
INIT = (
    "undefined reference to `ros::init(int&, char**, std::__cxx11::basic_string<char, "
    "std::char_traits<char>, std::allocator<char> > const&, unsigned int)'"
)
METHOD = (
    "undefined reference to `Teleop::callback(boost::shared_ptr<sensor_msgs::Joy_<std::allocator"
    "<void> > const> const&)'"
)


@claim("An error of the linker names the target, its line and the usual cause")
@pytest.mark.parametrize(("error", "cmake", "line", "words"), [
    (INIT, CMAKE, "CMakeLists.txt:3",
     "write target_link_libraries(mine_talker ${catkin_LIBRARIES})"),
    (INIT, CMAKE + LINKED.replace("catkin", "CATKIN"), "CMakeLists.txt:4",
     "the libraries of ROS are in ${catkin_LIBRARIES}"),
    (INIT, CMAKE.replace("roscpp", "std_msgs") + LINKED, "CMakeLists.txt:3",
     "name roscpp in find_package"),
    ("undefined reference to `greet(int)'", CMAKE + LINKED, "CMakeLists.txt:3",
     "src/greet.cpp has it: add_executable(mine_talker ...) needs that file, too"),
    ("undefined reference to `other()'", CMAKE + LINKED, "CMakeLists.txt:3",
     "the .cpp file that has it belongs into add_executable"),
    (METHOD, CMAKE + LINKED, "src/talker.cpp:2",
     "Teleop::callback is declared, and nothing defines"),
    ("multiple definition of `main'; CMakeFiles/mine_talker.dir/src/talker.cpp.o:talker.cpp:"
     "(.text+0xb): first defined here", CMAKE + LINKED, "CMakeLists.txt:3",
     "each program has its own add_executable"),
    ("undefined reference to `main'", CMAKE + LINKED, "CMakeLists.txt:3", "no int main(...)"),
    ("cannot find -ljoystick: No such file or directory", CMAKE + LINKED, "CMakeLists.txt:3",
     "there is no library joystick"),
])  # fmt: skip
def test_an_error_of_the_linker_has_its_line_and_cause(error, cmake, line, words, make_submission):
    session = make_submission("mine", "2")
    files = {
        "CMakeLists.txt": cmake,
        "src/talker.cpp": "class Teleop {\n  void callback(int);\n};\n",
        "src/greet.cpp": "void greet(int) {}\n",
    }
    for path, text in files.items():
        (session.source / "mine" / path).parent.mkdir(exist_ok=True)
        (session.source / "mine" / path).write_text(text)
    output = (
        "/usr/bin/ld: CMakeFiles/mine_talker.dir/src/talker.cpp.o: in function `main':\n"
        f"talker.cpp:(.text+0x71): {error}\ncollect2: error: ld returned 1 exit status\n{FAILED}"
    )
    wrong = build_error(session, output)
    assert wrong.where == f"mine/{line}"
    assert words in wrong.hint
    assert wrong.seen.startswith("mine_talker: ")
    assert "allocator" not in wrong.seen


def test_the_target_is_that_which_fails_after_the_error(make_submission):
    session = make_submission("mine", "2")
    cmake = "add_executable(mine_talker a.cpp)\nadd_executable(mine_other b.cpp)\n"
    (session.source / "mine/CMakeLists.txt").write_text(cmake)
    other = FAILED.replace("mine_talker", "mine_other")
    output = f"{other}/usr/bin/ld: a.o: undefined reference to `f()'\n{FAILED}"
    assert build_error(session, output).where == "mine/CMakeLists.txt:1"
