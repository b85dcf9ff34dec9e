"""The lines of a build that say what is wrong."""

from tutorial_tools.command.build_errors import first_errors

# as Debian's programs print it
CMAKE = """\
-- nosetests not found, Python tests can not be run (try installing package 'python3-nose')
-- Could not find the required component 'nowhere'. The following CMake error indicates that you
CMake Error at /usr/share/catkin/cmake/catkinConfig.cmake:82 (find_package):
  Could not find a package configuration file provided by "nowhere" with any
  of the following names:

    nowhereConfig.cmake
Call Stack (most recent call first):
  mine/CMakeLists.txt:3 (find_package)


-- Configuring incomplete, errors occurred!
Invoking "cmake" failed
"""
COMPILER = """\
[ 50%] Building CXX object mine/CMakeFiles/a.dir/a.cpp.o
/ws/src/mine/a.cpp: In function 'int main()':
/ws/src/mine/a.cpp:1:14: error: 'foo' was not declared in this scope
    1 | int main() { foo(); }
      |              ^~~
make[2]: *** [mine/CMakeFiles/a.dir/build.make:76: mine/CMakeFiles/a.dir/a.cpp.o] Error 1
"""


def test_an_error_has_its_message():
    lines = CMAKE.splitlines()
    assert first_errors(lines) == [*lines[2:5], lines[6]]


def test_an_error_of_the_compiler_has_the_line_of_the_program():
    lines = COMPILER.splitlines()
    assert first_errors(lines) == lines[2:]


def test_at_most_eight_lines_or_the_last_one():
    assert first_errors(["error"] * 20) == ["error"] * 8
    assert first_errors(["-- looks", "Killed"]) == ["Killed"]
    assert first_errors([]) == []
