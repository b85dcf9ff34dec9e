"""From what the compiler printed to the student's line and the usual cause."""

import re
from pathlib import Path

import pytest

from tutorial_check.checking.build_errors import build_error
from tutorial_check.checking.compiler_errors import plain
from tutorial_testing.claims import claim

OUTPUTS = Path(__file__).with_name("compiler_outputs.txt").read_text(encoding="utf-8")
ROWS = [block.splitlines() for block in OUTPUTS.strip().split("\n\n")[1:]]
OBJECT = "mine/CMakeFiles/talker.dir/src/talker.cpp.o"
FAILED = f"\nmake[2]: *** [mine/CMakeFiles/talker.dir/build.make:76: {OBJECT}] Error 1\n"


@pytest.fixture
def compiled(make_submission):
    """compiled(program, output, cmake): the Wrong of a build; @ is the program in the output."""

    def error_of(program, output, cmake="add_executable(talker src/talker.cpp)\n"):
        session = make_submission("mine", "2")
        source = session.source / "mine/src/talker.cpp"
        source.parent.mkdir()
        source.write_text(program)
        (session.source / "mine/CMakeLists.txt").write_text(cmake)
        return build_error(session, output.replace("@", str(source)) + FAILED)

    return error_of


@claim("An error of the C++ compiler has the student's line, a plain sentence and its usual cause")
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_an_error_of_the_compiler_has_its_line_and_cause(row, compiled):
    texts = dict(line.split("|", 1) for line in row[1:] if re.match(r"\d+\|", line))
    program = [texts.get(str(number), "") for number in range(1, 50)]
    wrong = compiled("\n".join(program), "\n".join(row[1 + len(texts) : -1]))
    line, words = row[-1][2:].split(" ", 1)
    assert wrong.where == f"mine/src/talker.cpp:{line}"
    assert words in wrong.hint
    assert not re.search(r"allocator|__cxx11|\[with|\{aka|root", wrong.seen)


@claim("A C++ standard in CMakeLists.txt that ROS's headers cannot use is blamed, not the headers")
@pytest.mark.parametrize("output", [
    "In file included from @:1:\n/usr/include/c++/12/bits/c++0x_warning.h:32:2: error: #error This "
    "file requires compiler and library support for the ISO C++ 2011 standard.",
    "/usr/include/std_msgs/String.h:36:121: error: no class template named \u2018rebind\u2019 in "
    "\u2018class std::allocator<void>\u2019",
    "@:5:8: error: \u2018make_unique\u2019 is not a member of \u2018std\u2019\n@:5:8: note: "
    "\u2018std::make_unique\u2019 is only available from C++14 onwards",
])  # fmt: skip
@pytest.mark.parametrize("line", ["add_compile_options(-std=c++98)", "set(CMAKE_CXX_STANDARD 98)"])
def test_a_standard_that_the_headers_cannot_use_is_blamed(output, line, compiled):
    wrong = compiled("", output, f"project(mine)\n{line}\nadd_executable(talker src/talker.cpp)\n")
    assert (wrong.where, "take it out" in wrong.hint) == ("mine/CMakeLists.txt:2", True)


def test_what_is_newer_than_the_standard_is_blamed_on_its_own_line(compiled):
    output = (
        "@:5:8: error: 'span' is not a member of 'std'\n"
        "@:5:8: note: 'std::span' is only available from C++20 onwards"
    )
    wrong = compiled("", output)
    assert wrong.where == "mine/src/talker.cpp:5"
    assert wrong.hint.startswith("this is C++20, newer than what is compiled here")


@claim("A compiler that a limit ends, and what a program includes of the system, is one line")
@pytest.mark.parametrize(("program", "output", "where", "words"), [
    ('\n#include "/dev/zero"\n', "\ncc1plus: out of memory allocating 2147483664 bytes after a "
     "total of 6094848 bytes", "mine/src/talker.cpp:2", "a program includes headers of packages"),
    ("#include <x>\n", "\nvirtual memory exhausted: Cannot allocate memory", "mine/src/talker.cpp",
     "more memory or time than a build has"),
    ("", "c++: fatal error: Killed signal terminated program cc1plus\ncompilation terminated.",
     "mine/src/talker.cpp", "more memory or time than a build has"),
    ("", "@:5:1: internal compiler error: Segmentation fault\n", "mine/src/talker.cpp",
     "more memory or time than a build has"),
    ("", "c++: error: unrecognized command-line option \u2018src/talker.cpp\u2019; did you mean "
     "\u2018x\u2019?", "mine/CMakeLists.txt:1", "g++ has no such option"),
])  # fmt: skip
def test_a_compiler_that_does_not_finish_is_one_line(program, output, where, words, compiled):
    wrong = compiled(program, output)
    assert wrong.where == where
    assert words in wrong.hint


def test_an_include_of_a_system_file_shows_nothing_of_it(compiled):
    output = "In file included from @:2:\n/etc/shadow:1:1: error: 'root' does not name a type"
    wrong = compiled('\n#include "/etc/shadow"\n', output)
    assert wrong.seen == "#include of a file outside of the package"
    assert "root" not in f"{wrong}{vars(wrong)}"


def test_tabs_count_as_the_columns_of_the_compiler(compiled):
    program = "int main() {\n\tros::Rate rate(10)\n\tint n = 0;\n}\n"
    wrong = compiled(
        program, "@:3:9: error: expected \u2018,\u2019 or \u2018;\u2019 before \u2018int\u2019"
    )
    assert wrong.where == "mine/src/talker.cpp:2"


@pytest.mark.parametrize(("message", "words"), [
    ("no match for \u2018f\u2019 [with T = std::vector<int>]", "no match for \u2018f\u2019"),
    ("\u2018std::__cxx11::basic_string<char>\u2019", "\u2018std::string\u2019"),
    ("\u2018boost::function<void(const boost::shared_ptr<const std_msgs::String_<std::allocator"
     "<void> > >&)>\u2019", "\u2018boost::function<void(const std_msgs::String::ConstPtr&)>\u2019"),
    ("\u2018a<b<c<d> >, e<f> >\u2019", "\u2018a<b, e >\u2019"),
    ("no match for \u2018operator<<\u2019 (\u2018std::ostream\u2019 and \u2018T\u2019)",
     "no match for \u2018operator<<\u2019 (\u2018std::ostream\u2019 and \u2018T\u2019)"),
])  # fmt: skip
def test_the_compiler_s_sentence_is_without_noise(message, words):
    assert plain(message) == words
