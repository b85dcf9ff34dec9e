"""Right solutions, the suite's, a literal one and many variants: nothing is called wrong."""

import os
import subprocess

import pytest
from edits import apply
from variants import TELLS

from tutorial_check.course import read_course
from tutorial_check.examination import examine
from tutorial_check.model import CannotCheck
from tutorial_check.report import lines_of

NOETIC = "/opt/ros/noetic/setup.bash"  # where ROS is not of Debian


def check(workspace, underlay, exercises, record_property):
    """Examine; the outcomes; fails with the report of what is called wrong."""
    record_property("solution", str(workspace))
    try:
        outcomes = examine(workspace, underlay, exercises)
    except CannotCheck as error:
        record_property("no verdict", str(error))
        raise
    wrong = [
        result
        for outcome in outcomes
        for result in outcome.results
        if result.status in ("wrong", "unreached")
    ]
    record_property("checks", sum(len(outcome.results) for outcome in outcomes))
    for result in wrong:
        record_property("alarm", " / ".join(lines_of(result)))
    assert not wrong, "\n".join(line for result in wrong for line in lines_of(result))
    return outcomes


def test_the_solutions_of_the_suite(solutions, underlay, record_property):
    exercises = [*read_course().by_default, "7"]
    outcomes = check(solutions.parent, underlay, exercises, record_property)
    assert [outcome.id for outcome in outcomes] == exercises


def test_a_literal_solution(literal, underlay, record_property):
    outcomes = check(literal.parent, underlay, read_course().by_default, record_property)
    seen = {result.id: result.status for outcome in outcomes for result in outcome.results}
    assert len(seen) == 34
    # What the handout's own listings do is worth a word, no more.
    assert [seen[check] for check in ("C18", "C20", "C29", "C32", "C33")] == ["note"] * 5


def test_an_except_that_tells_hides_nothing(literal, underlay, record_property):
    _, edits, exercises = TELLS
    apply(edits, literal)
    (outcome,) = check(literal.parent, underlay, exercises, record_property)
    assert [one.status for one in outcome.results if one.id == "C33"] == ["ok"]


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
    seen = {result.id: (result.status, result.seen) for result in outcome.results}
    assert seen["C1"][0] == status, seen["C1"]


def test_variant(variant, literal, underlay, record_property):
    _, edits, exercises = variant
    apply(edits, literal)
    check(literal.parent, underlay, exercises, record_property)
