"""How long a check of the suite's own solutions takes."""

import os
import shutil
import time

from tutorial_check.course.definition import read_course
from tutorial_check.examining.examination import examine
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

ONE_S, ALL_S = 15.0, 90.0  # on two idle processors


@claim("An exercise is checked within 15 s, all within 90 s")
def test_each_exercise_and_all_of_them(tmp_path, figure):
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, tmp_path / "ws" / "src" / name)
    course, late = read_course(), []
    parts = {f"{name} {course.exercises[name].title}": [name] for name in course.by_default}
    for what, exercises in {**parts, "all of them": course.by_default}.items():
        began_s = time.monotonic()
        order = Order(tmp_path / "ws", os.environ["TUTORIAL_UNDERLAY"], exercises)
        outcomes = examine(order, side_by_side=True)
        took_s = time.monotonic() - began_s
        assert all(outcome.passed for outcome in outcomes), outcomes
        longest_s = ALL_S if exercises[1:] else ONE_S
        figure(what, f"{took_s:.1f} s", f"≤ {longest_s:.0f} s")
        late += [what] if took_s > longest_s else []
    assert not late
