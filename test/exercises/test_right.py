"""Right solutions, the suite's, a literal one and many variants: nothing is called wrong."""

import os
import subprocess

import pytest
from edits import JOY2TWIST, LAUNCH_BAG, apply, put
from variants import REPORTS

from tutorial_check.course import read_course
from tutorial_check.examination import examine
from tutorial_check.report import lines_of

NOETIC = "/opt/ros/noetic/setup.bash"  # where ROS is not of Debian
# What is right and worth a note: (what, edits, exercises, check, words of the note; none: no note).
NOTES = [
    ("a gap in a node's name", [put(LAUNCH_BAG, "my_rviz", "my rviz")], ["5"], "C22", ("launch_bag.launch:2", 'name="my_rviz"')),
    ("half as fast", [put(JOY2TWIST, "= data.axes[1]", "= 0.5*data.axes[1]")], ["4.3"], "C16", ("linear.x = 0.50 * axes[1]",)),
    ("loginfo_throttle", [put(JOY2TWIST, "rospy.loginfo(", "rospy.loginfo_throttle(1.0, ")], ["4.3"], "C14", ("now and then", "joy2twist.py:9")),
    ("two curves", [put(JOY2TWIST, "= data.axes[1]", "= data.axes[1] ** 3"), put(JOY2TWIST, "= data.axes[0]", "= data.axes[0] ** 3")], ["4.3"], "C16", ("are curves of their axes",)),
    (*REPORTS, "C33", ()),
]  # fmt: skip


@pytest.fixture
def check(underlay):
    """check(workspace, exercises): {id: result}; fails with what is called wrong."""

    def judge(workspace, exercises):
        outcomes = examine(workspace, underlay, exercises)
        assert [outcome.id for outcome in outcomes] == exercises
        results = [result for outcome in outcomes for result in outcome.results]
        assert not [lines_of(one) for one in results if one.status in ("wrong", "unreached")]
        return {result.id: result for result in results}

    return judge


def test_the_solutions_of_the_suite(solutions, check):
    check(solutions.parent, [*read_course().by_default, "7"])


def test_a_literal_solution(literal, check):
    seen = check(literal.parent, read_course().by_default)
    assert len(seen) == 34
    # What the handout's own listings do is worth a word, no more.
    assert {seen[each].status for each in ("C18", "C20", "C29", "C32", "C33")} == {"note"}


@pytest.mark.parametrize("row", NOTES, ids=lambda row: row[0])
def test_note(row, literal, check):
    _, edits, exercises, name, words = row
    apply(edits, literal)
    found = check(literal.parent, exercises)[name]
    assert found.status == ("note" if words else "ok")
    reported = "\n".join(lines_of(found))
    assert all(word in reported for word in words), reported


@pytest.mark.parametrize(
    ("below", "status"), [("underlay", "ok"), ("nothing of the suite", "wrong")]
)
def test_a_workspace_that_was_built(literal, underlay, below, status):
    """As catkin writes its devel folder, over the suite or without it."""
    under = underlay if below == "underlay" else NOETIC
    build = f"[ ! -e '{under}' ] || . '{under}'; catkin_make"
    environment = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"]}
    subprocess.run(["bash", "-c", build], cwd=literal.parent, check=True, env=environment)
    (outcome,) = examine(literal.parent, underlay, ["2"])
    assert next(one.status for one in outcome.results if one.id == "C1") == status


def test_variant(variant, literal, check):
    _, edits, exercises = variant
    apply(edits, literal)
    check(literal.parent, exercises)
