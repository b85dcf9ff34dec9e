"""How long a check of the suite's own solutions takes, beside a rostest with a single node."""

import os
import shutil
import subprocess
import time
from pathlib import Path

from tutorial_check.course import read_course
from tutorial_check.launcher import examine

REPOSITORY = Path(__file__).resolve().parents[3]
ONE_S, ALL_S = 15.0, 90.0  # on two processors with nothing else to do
ROSTEST = """<launch>
  <node pkg="beginner_tutorials" type="talker.py" name="talker"/>
  <test pkg="rostest" type="publishtest" test-name="bare_rostest">
    <rosparam>topics: [{name: /chatter, timeout: 60, negative: false}]</rosparam>
  </test>
</launch>
"""


def seconds_of(work, *words):
    """Return (how long some work takes [s], what it returns)."""
    began_s = time.monotonic()
    result = work(*words)
    return time.monotonic() - began_s, result


def test_each_exercise_and_all_of_them(tmp_path, figure):
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, tmp_path / "ws" / "src" / name)
    (tmp_path / "bare.test").write_text(ROSTEST)
    rostest = ["rostest", f"--pkgdir={tmp_path}", "--package=bare", tmp_path / "bare.test"]
    course, late = read_course(), []
    parts = {f"{name} {course.exercises[name].title}": [name] for name in course.by_default}
    for what, exercises in {**parts, "all of them": course.by_default}.items():
        # Again each time: what else runs here changes.
        bare_s, _ = seconds_of(
            lambda: subprocess.run(rostest, check=True, stdout=subprocess.DEVNULL)
        )
        words = tmp_path / "ws", os.environ["TUTORIAL_UNDERLAY"], exercises
        took_s, outcomes = seconds_of(examine, *words)
        assert all(outcome.passed for outcome in outcomes), outcomes
        longest_s = ALL_S if exercises[1:] else ONE_S
        figure(what, f"{took_s:.1f} s, {took_s / bare_s:.1f} rostests", f"≤ {longest_s:.0f} s")
        late += [what] if took_s > longest_s else []
    assert not late
