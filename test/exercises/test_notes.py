"""What is right and yet worth a word: (exercise, what, edits, check, words of the note)."""

import pytest
from edits import JOY2TWIST, LAUNCH_BAG, apply, put

from tutorial_check.examination import examine
from tutorial_check.report import lines_of

ROWS = [
    ("5", "a gap in a node's name", [put(LAUNCH_BAG, "my_rviz", "my rviz")], "C22", ("launch_bag.launch:2", 'name="my_rviz"')),
    ("4.3", "half as fast", [put(JOY2TWIST, "= data.axes[1]", "= 0.5*data.axes[1]")], "C16", ("linear.x = 0.50 * axes[1]",)),
    ("4.3", "loginfo_throttle", [put(JOY2TWIST, "rospy.loginfo(", "rospy.loginfo_throttle(1.0, ")], "C14", ("now and then", "joy2twist.py:9")),
    ("4.3", "two curves", [put(JOY2TWIST, "= data.axes[1]", "= data.axes[1] ** 3"), put(JOY2TWIST, "= data.axes[0]", "= data.axes[0] ** 3")], "C16", ("are curves of their axes",)),
]  # fmt: skip


@pytest.mark.parametrize("row", ROWS, ids=[f"{row[0]} {row[1]}" for row in ROWS])
def test_note(row, literal, underlay):
    exercise, _, edits, check, words = row
    apply(edits, literal)
    (outcome,) = examine(literal.parent, underlay, [exercise])
    assert not [one for one in outcome.results if one.status == "wrong"]
    (note,) = [one for one in outcome.results if one.id == check]
    assert note.status == "note"
    told = "\n".join(lines_of(note))
    assert all(word in told for word in words), told
