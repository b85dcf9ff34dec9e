"""Why a program ends at once without a word."""

import pytest

from tutorial_check.exercises.silent_end import silent_end
from tutorial_check.python_facts import read_python

PROGRAM = """def listener():
    rospy.Subscriber("/joy", Joy, callback)
    {spin}
{margin}if __name__ == '__main__':
{margin}    listener()
"""


@pytest.mark.parametrize(
    ("spin", "margin", "where", "word"),
    [
        ("rospy.spin", "", "x.py:3", "rospy.spin()"),
        ("pass", "", "x.py", "is missing"),
        ("rospy.spin()", "    ", "x.py:4", "stands within listener(): move it"),
        ("rospy.spin()", "", "x.py", "in the last line"),
    ],
)
def test_the_reason(spin, margin, where, word):
    place, hint = silent_end(read_python(PROGRAM.format(spin=spin, margin=margin)), "x.py")
    assert place == where
    assert word in hint
