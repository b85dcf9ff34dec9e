"""Facts from a program's text, and the same program with one thing changed."""

import functools

import pytest

from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.python_text import flipped_anonymous, unmasked, without_name
from tutorial_testing.claims import claim

ANONYMOUS = functools.partial(flipped_anonymous, wanted=True)
NO_JOY = functools.partial(without_name, name="Joy")
PROGRAM = """rospy.init_node("a", anonymous=False)
try:
    rospy.spin()
except:
    pass
"""


@pytest.mark.parametrize("text", ["lambda:" * 10**5 + "1", "1" + "**1" * 10**5, "a" + "()" * 10**5])
def test_a_program_that_is_nested_too_deeply_is_one_that_cannot_be_read(text):
    assert PythonFacts(text).error


def test_a_warning_is_no_error_and_not_shown(recwarn):
    assert not PythonFacts("x = 1 is 1\ny = '\\d'\n").error
    assert not recwarn


@claim("A character of a PDF that ends no line for Python moves no line number")
@pytest.mark.parametrize("odd", ["\f", "\v", "\x1c", "\x85", "\u2028"])  # copied from a PDF
def test_a_character_that_ends_no_line_for_python_ends_none_here(odd):
    wrong = PythonFacts(f"# {odd}\nfrom std msgs.msg import String")
    assert wrong.error_text.startswith("from std")
    assert PythonFacts(f"# {odd}\nif name == ' main ':\n    pass").odd_main[1].startswith("if name")
    text = f"# a page{odd}and the next\r\n{PROGRAM}"
    assert 'init_node("a", anonymous=True)' in ANONYMOUS(text)
    assert "except ():\n    pass" in unmasked(text)
    assert NO_JOY(f"{text}from m import Joy").endswith("from m import Joy\ndel Joy\n")


IMPORT = "if True:\n    from sensor_msgs.msg import (\n        Joy,\n    )\n"


@claim("A program is tried again with one thing changed, and nothing else")
@pytest.mark.parametrize(("change", "text", "changed"), [
    (unmasked, "x = 1\n", None),
    (ANONYMOUS, 'rospy.init_node("é")\n', 'rospy.init_node("é", anonymous=True)\n'),
    (ANONYMOUS, "rospy.init_node(name, anonymous=choice)", None),
    (NO_JOY, f"{IMPORT}print(Joy)\n", f"{IMPORT}    del Joy\nprint(Joy)\n"),
    (NO_JOY, "import sensor_msgs.msg\n", None),
])  # fmt: skip
def test_the_same_program_with_one_thing_changed(change, text, changed):
    assert change(text) == changed
