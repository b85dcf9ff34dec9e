"""Checks that start no node: right files are not blamed, each mistake in them is found."""

import os
import shutil
from pathlib import Path

import edits
import mistakes_launch
import mistakes_nodes
import mistakes_packages
import pytest
from test_mistakes import is_reported

from tutorial_check.course import checks_of, read_course
from tutorial_check.handout.task import JoystickTask
from tutorial_check.isolation.environment import prepare, variables
from tutorial_check.isolation.runner import Runner
from tutorial_check.model import NOTE, OK, WRONG, Run
from tutorial_check.record.ground import Ground
from tutorial_check.report.text import lines_of
from tutorial_check.source.workspace import find_layout

REPOSITORY = Path(__file__).resolve().parents[3]
PACKAGES = f"{REPOSITORY}/common:{REPOSITORY}/fake_turtlebot_sim:/usr/share"
LITERAL = Path(__file__).resolve().parents[2] / "exercises" / "literal"
READ_ALONE = ("C1", "C2", "C3", "C5", "C12", "C13", "C29")
CHECKS = checks_of(read_course())
SLOW = ("C4", "C21", "C22", "C25")  # catkin_make builds, or roslaunch reads: a second or more
ROWS = [
    *(row for row in mistakes_packages.ROWS + mistakes_nodes.ROWS if row[3] in READ_ALONE),
    *[row for row in mistakes_packages.ROWS + mistakes_launch.ROWS if row[3] in SLOW][::8],
]


@pytest.fixture
def judge(tmp_path):
    """judge(checks, edits): the results of these checks of the right solution, once changed."""

    runner = Runner(variables(tmp_path, {**os.environ, "ROS_PACKAGE_PATH": PACKAGES}))

    def judged(checks, changes=()):
        source = shutil.copytree(LITERAL, tmp_path / "ws" / "src")
        shutil.copytree(REPOSITORY / "joy2twist/bag", source / "joy2twist/bag")
        edits.apply(changes, source)
        prepare(tmp_path, None)
        (tmp_path / "lower" / "share" / "fake_turtlebot_sim").mkdir(parents=True)
        session = Ground(
            tmp_path, find_layout(tmp_path / "ws"), ["2", "3", "4.3", "6.2"], runner,
            underlay=str(tmp_path / "lower" / "setup.bash"), can_have_devices=False,
            task=JoystickTask({}),
        )  # fmt: skip
        run = Run(CHECKS, session, lambda _: False, lambda: False)
        return [run.result(each) for each in checks]

    yield judged
    runner.clear()


def test_a_right_solution_is_not_blamed(judge):
    assert {one.status for one in judge(READ_ALONE + SLOW)} == {OK, NOTE}


@pytest.mark.parametrize("row", ROWS, ids=[f"{row[3]} {row[1]}" for row in ROWS])
def test_a_mistake_in_a_file_is_found(judge, row):
    _, _, changes, check, words = row
    (one,) = judge([check], changes)
    assert one.status == WRONG and is_reported(one, words), lines_of(one)
