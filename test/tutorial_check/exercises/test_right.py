"""Right solutions: the suite's, a literal one and many variants; none is called wrong."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
import variants
from edits import apply
from notes import NOTES
from test_mistakes import is_reported

from tutorial_check.checking.checks import checks_of
from tutorial_check.course.definition import read_course
from tutorial_check.examining.examination import examine
from tutorial_check.report.text import lines_of
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

CHECKS = checks_of(read_course())
NOETIC = "/opt/ros/noetic/setup.bash"  # on systems whose ROS is not Debian's


@claim(
    "The suite's own solutions, and a literal solution of the handout, are right; what the "
    "handout's listings do is a note"
)
@claim("The three steps display, publish and end as the handout has it, 45 lines each")
def test_the_solutions_of_the_suite_are_right(tmp_path, check):
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, tmp_path / "ws" / "src" / name)
    check(tmp_path / "ws", [*read_course().by_default, "7"])


@claim("The suite's own solutions, and a literal ...", because="a literal solution")
def test_a_literal_solution_is_right_and_noted(literal, check):
    exercises = read_course().by_default
    seen = check(literal.parent, exercises)
    assert seen.keys() == {made.id for made in CHECKS if made.exercise in exercises}
    # What the handout's own listings do is at most worth a note.
    assert {seen[name].status for name in ("C18", "C20", "C29", "C32", "C33")} == {"note"}
    assert seen["C29"].where == "scripts/new_joy2twist.py:11"  # on_shutdown before the publisher


@claim("What is right and worth knowing is a note, with its line")
@pytest.mark.parametrize("row", NOTES, ids=str)
def test_a_right_solution_is_noted(row, literal, check):
    apply(row.edits, literal)
    results = check(literal.parent, row.exercises)
    for name, words in row.notes.items():
        assert results[name].status == ("note" if words else "ok")
        assert is_reported(results[name], words), lines_of(results[name])


@claim(
    "A devel folder must be whole and built over this suite, or over a ROS in /opt/ros; a "
    "committed one of another home, or without setup.*, is ignored"
)
@pytest.mark.parametrize(
    ("below", "status"), [("underlay", "ok"), ("nothing of the suite", "wrong")]
)
def test_below_what_a_workspace_was_built(literal, underlay, below, status):
    """The devel folder is catkin's own, built over the suite or without it."""
    under = underlay if below == "underlay" else NOETIC
    build = f"[ ! -e '{under}' ] || . '{under}'; catkin_make"
    environment = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"]}
    subprocess.run(["bash", "-c", build], cwd=literal.parent, check=True, env=environment)
    (outcome,) = examine(Order(literal.parent, underlay, ["2"]))
    if status == "wrong" and Path(NOETIC).exists():
        status = "note"  # correct for a ROS in /opt/ros
    assert next(result.status for result in outcome.results if result.id == "C1") == status


@claim(
    "Other right solutions (shebangs, folders, topics, limits, dead-man buttons, launch files, "
    "worlds; classes, of several the last; recordings, of several that of /joy; 68 of a grammar) "
    "are not blamed"
)
@pytest.mark.parametrize("row", variants.ROWS, ids=str)
def test_a_variant_is_right(row, literal, check):
    apply(row.edits, literal)
    check(literal.parent, row.exercises)
