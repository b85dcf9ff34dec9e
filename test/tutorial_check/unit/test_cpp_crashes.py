"""The line to blame for a program in C++ that fails, and the fix."""

import pytest

from tutorial_check.checking.cpp_crashes import blamed
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_testing.claims import claim

TEXT = """int main(int argc, char** argv) {
  ros::init(argc, argv, "my talker");
  ros::NodeHandle n;
  ros::Rate rate(0);
  throw std::runtime_error("no text");
}
"""
NAME = "ros::InvalidNameException: Character [ ] at element [2] is not valid in Graph Resource Name"


@claim("A program in C++ that fails is reported ...", because="its line, and the usual cause")
@pytest.mark.parametrize(("error", "line", "words"), [
    (f"{NAME} [my talker].  Valid characters are a-z", 2, "letters, digits"),
    ("ros::InvalidNameException: The node name must not be empty", 2, "third argument"),
    ("You must call ros::init() before creating the first NodeHandle", 3, "first line of main"),
    ("std::runtime_error: Duration is out of dual 32-bit range", 4, "more than 0"),
    ("std::runtime_error: no text", 5, ""), ("std::runtime_error: other text", 0, ""),
    ("SIGFPE, a whole number divided by 0", 0, "divided by 0"), ("int", 0, ""), ("", 0, ""),
])  # fmt: skip
def test_the_line_of_an_error(error, line, words):
    place, hint = blamed(error, CppFacts({"src/talker.cpp": TEXT}))
    assert place == line
    assert words in hint
