"""From what a program printed to the cause."""

import pytest

from tutorial_check.tracebacks import (
    explain,
    first_traceback,
    last_lines,
    misspelt,
    syntax_hint,
)

OUTPUT = """[ERROR] [1.0]: bad callback: <function callback at 0x7f>
Traceback (most recent call last):
  File "/usr/lib/python3/dist-packages/rospy/topics.py", line 750, in _invoke_callback
    cb(msg)
  File "/tmp/ws/joy2twist/scripts/joy2twist.py", line 12, in callback
    msg.linear.x = data.axes(1)
                   ^^^^^^^^^^^^
TypeError: 'tuple' object is not callable

more
"""


def test_the_students_own_line():
    trace = first_traceback(OUTPUT, "/tmp/ws/joy2twist")
    assert trace.where == "scripts/joy2twist.py:12"
    assert trace.text == "msg.linear.x = data.axes(1)"
    assert trace.error == "TypeError: 'tuple' object is not callable"
    assert "square brackets" in explain(trace.error)


def test_a_topic_that_rospy_closed_at_the_end_is_no_mistake():
    ended = OUTPUT.replace(
        "TypeError: 'tuple' object is not callable",
        "rospy.exceptions.ROSException: publish() to a closed topic",
    )
    assert first_traceback(ended, "/tmp/ws/joy2twist") is None
    assert first_traceback(ended + OUTPUT, "/tmp/ws/joy2twist").error.startswith("TypeError")


@pytest.mark.parametrize("ending", ["", ":", ":\n"])
def test_one_that_was_cut_off_at_its_first_line_tells_nothing(ending):
    cut_off = f"Traceback (most recent call last){ending}"
    assert first_traceback(cut_off, "/tmp/ws") is None
    assert first_traceback(OUTPUT + cut_off, "/tmp/ws/joy2twist").error.startswith("TypeError")


def test_no_traceback():
    assert first_traceback("all is well", "/tmp") is None


@pytest.mark.parametrize(
    "error, word",
    [
        ("NameError: name 'pub' is not defined", "global"),
        ("NameError: name 'msg' is not defined. Did you mean: 'msq'?", "msq"),
        ("ModuleNotFoundError: No module named 'std_msg'", "std_msgs.msg"),
        ("TypeError: callback() missing 1 required positional argument: 'data'", "without ()"),
        ("TypeError: not all arguments converted during string formatting", "as many %.2f"),
        (
            "rospy.exceptions.ROSInitException: client code must call rospy.init_node() first",
            "init_node",
        ),
        ("rospkg.common.ResourceNotFound: joy2twst", "joy2twst"),
    ],
)
def test_causes(error, word):
    assert word in explain(error)


def test_an_unknown_error_is_not_explained():
    assert explain("ZeroDivisionError: division by zero") == ""


@pytest.mark.parametrize(
    "message, text, word",
    [
        ("invalid syntax", "from std msgs.msg import String", "underscores"),
        ("Missing parentheses in call to 'print'", "print data", "Python 2"),
        ("invalid character", "x = “a”", "curly"),
        ("expected ':'", "def f()", "ends with :"),
        ("'(' was never closed", "f(", "bracket"),
        ("unexpected indent", "  x = 1", "indent"),
    ],
)
def test_syntax(message, text, word):
    assert word in syntax_hint(message, text)


def test_last_lines_have_no_colours():
    assert last_lines("\x1b[31ma\x1b[0m\n\nb\nc\nd\n") == "b / c / d"


def test_a_name_like_the_one_that_is_missing():
    names = {"msq": 10, "data": 8, "sub": 20}
    assert "msq in line 10" in misspelt("NameError: name 'msg' is not defined", names)
    assert "data in line 8" in misspelt("NameError: name 'date' is not defined", names)
    for error in ("name 'pub' is not defined", "name 'msq' is not defined", "IndexError: list"):
        assert not misspelt(error, names)
