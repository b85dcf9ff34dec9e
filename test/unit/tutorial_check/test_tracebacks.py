"""From what a program printed to its traceback."""

import pytest

from tutorial_check.causes import explain
from tutorial_check.tracebacks import first_traceback, last_lines

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


CLOSED_MEANWHILE = """Traceback (most recent call last):
  File "/usr/lib/python3/dist-packages/rospy/topics.py", line 1085, in publish
    self.message_data_sent += b.tell() #STATS
ValueError: I/O operation on closed file.

During handling of the above exception, another exception occurred:

"""


@pytest.mark.parametrize(
    ("before", "error"),
    [("", "publish() to a closed topic"), (CLOSED_MEANWHILE, "topic was closed during publish()")],
)
def test_a_topic_that_rospy_closed_at_the_end_is_no_mistake(before, error):
    mistake = "TypeError: 'tuple' object is not callable"
    ended = before + OUTPUT.replace(mistake, f"rospy.exceptions.ROSException: {error}")
    assert first_traceback(ended, "/tmp/ws/joy2twist") is None
    assert first_traceback(ended + OUTPUT, "/tmp/ws/joy2twist").error.startswith("TypeError")


@pytest.mark.parametrize("ending", ["", ":", ":\n"])
def test_one_that_was_cut_off_at_its_first_line_tells_nothing(ending):
    cut_off = f"Traceback (most recent call last){ending}"
    assert first_traceback(cut_off, "/tmp/ws") is None
    assert first_traceback(OUTPUT + cut_off, "/tmp/ws/joy2twist").error.startswith("TypeError")


def test_no_traceback():
    assert first_traceback("all is well", "/tmp") is None


def test_last_lines_have_no_colours():
    assert last_lines("\x1b[31ma\x1b[0m\n\nb\nc\nd\n") == "b / c / d"
