"""How long a check of the suite's own solutions takes, beside a rostest with a single node."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from tutorial_check.course import read_course
from tutorial_check.examination import examine
from tutorial_check.model import NOTE, OK

REPOSITORY = Path(__file__).resolve().parents[3]
ONE_S, ALL_S = 15.0, 90.0  # on two processors with nothing else to do
ROSTEST = """<launch>
  <node pkg="beginner_tutorials" type="talker.py" name="talker"/>
  <test pkg="rostest" type="publishtest" test-name="bare_rostest">
    <rosparam>topics: [{name: /chatter, timeout: 60, negative: false}]</rosparam>
  </test>
</launch>
"""


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    """The suite's solutions, as somebody would hand them in."""
    folder = tmp_path_factory.mktemp("ws")
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, folder / "src" / name)
    return folder


def check_s(workspace, exercises):
    """How long a check takes [s], in which all is right."""
    began_s = time.monotonic()
    outcomes = examine(workspace, os.environ["TUTORIAL_UNDERLAY"], exercises)
    took_s = time.monotonic() - began_s
    assert not [one for each in outcomes for one in each.results if one.status not in (OK, NOTE)]
    assert all(outcome.passed for outcome in outcomes)
    return took_s


def rostest_s(file):
    """How long ROS's own way takes to start a master and a node and hear one message [s]."""
    file.write_text(ROSTEST)
    began_s = time.monotonic()
    command = ["rostest", f"--pkgdir={file.parent}", "--package=bare", file]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - began_s


def test_each_exercise_and_all_of_them(workspace, tmp_path, figure):
    course = read_course()
    parts = {f"{name} {course.exercises[name].title}": [name] for name in course.by_default}
    parts["all of them"] = course.by_default
    late = []
    for what, exercises in parts.items():
        bare_s = rostest_s(tmp_path / "bare.test")  # anew each time: what else runs here changes
        took_s, longest_s = check_s(workspace, exercises), ALL_S if exercises[1:] else ONE_S
        figure(what, f"{took_s:.1f} s, {took_s / bare_s:.1f} rostests", f"≤ {longest_s:.0f} s")
        if took_s > longest_s:
            late.append(what)
    assert not late
