"""Checks that start no node: right files are not blamed, each mistake in them is found."""

import json
import os
import shutil
from dataclasses import replace
from pathlib import Path

import edits
import mistakes_launch
import mistakes_nodes
import mistakes_packages
import pytest
from test_mistakes import is_reported

from tutorial_check.case import Case
from tutorial_check.course import checks_of, read_course
from tutorial_check.handout.task import JoystickTask
from tutorial_check.isolation.environment import prepare, variables
from tutorial_check.isolation.runner import Runner
from tutorial_check.model import NOTE, OK, WRONG, Run
from tutorial_check.record.ground import Ground
from tutorial_check.report.text import lines_of
from tutorial_check.source.workspace import COPY, find_layout
from tutorial_check.worker import answer
from tutorial_check.worker_process import as_handed_in

REPOSITORY = Path(__file__).resolve().parents[3]
PACKAGES = f"{REPOSITORY}/common:{REPOSITORY}/fake_turtlebot_sim:/usr/share"
LITERAL = Path(__file__).resolve().parents[2] / "exercises" / "literal"
EXERCISES = ("2", "3", "4.3", "6.2")
READ_ALONE = ("C1", "C2", "C3", "C5", "C12", "C13", "C29")
CHECKS = checks_of(read_course())
SLOW = ("C4", "C21", "C22", "C25")  # catkin_make builds, or roslaunch reads: a second or more
ROWS = [
    *(row for row in mistakes_packages.ROWS + mistakes_nodes.ROWS if row[3] in READ_ALONE),
    *[row for row in mistakes_packages.ROWS + mistakes_launch.ROWS if row[3] in SLOW][::8],
]


@pytest.fixture
def judge(tmp_path, order):
    """judge(checks, edits): the results of these checks of the right solution, once changed."""

    runner = Runner(variables(tmp_path, {**os.environ, "ROS_PACKAGE_PATH": PACKAGES}))

    def judged(checks, changes=()):
        source = shutil.copytree(LITERAL, tmp_path / COPY)
        shutil.copytree(REPOSITORY / "joy2twist/bag", source / "joy2twist/bag")
        edits.apply(changes, source)
        shutil.copytree(source, tmp_path / "ws/src", symlinks=True)
        prepare(tmp_path, None)
        (tmp_path / "lower" / "share" / "fake_turtlebot_sim").mkdir(parents=True)
        underlay = str(tmp_path / "lower" / "setup.bash")
        ground = Ground(
            tmp_path, find_layout(source.parent), EXERCISES, runner,
            underlay=underlay, can_have_devices=False, task=JoystickTask({}),
        )  # fmt: skip

        def ask(question):
            return json.loads(as_handed_in(json.dumps(answer(ground, question)), str(tmp_path)))

        asked = replace(
            order, root=str(source.parent), source=str(source), underlay=underlay,
            exercises=EXERCISES, environment=runner.environment, shown=(str(REPOSITORY),),
        )  # fmt: skip
        run = Run(CHECKS, Case(asked, JoystickTask({}), ask), lambda _: False, lambda: False)
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
