"""How long a check of the suite's own solutions takes."""

import os
import shutil
import statistics
import subprocess
import time

from tutorial_check.course.definition import read_course
from tutorial_check.data.recorders import BUILT
from tutorial_check.examining.examination import examine
from tutorial_check.recording.launcher import started
from tutorial_check.submission.order import Order, Question
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

ONE_S, ALL_S = 15.0, 90.0  # on two idle processors
CPP_MORE_S = BUILD_MORE_S = 2.0
TIMES = 3
UNDERLAY = os.environ["TUTORIAL_UNDERLAY"]
LITERAL = REPOSITORY / "test/tutorial_check/exercises"


@claim("An exercise is checked within 15 s, all within 90 s")
def test_each_exercise_and_all_of_them(tmp_path, figure):
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, tmp_path / "ws" / "src" / name)
    course, late = read_course(), []
    parts = {f"{name} {course.exercises[name].title}": [name] for name in course.by_default}
    for what, exercises in {**parts, "all of them": course.by_default}.items():
        began_s = time.monotonic()
        order = Order(tmp_path / "ws", UNDERLAY, exercises)
        outcomes = examine(order, side_by_side=True)
        took_s = time.monotonic() - began_s
        assert all(outcome.passed for outcome in outcomes), outcomes
        longest_s = ALL_S if exercises[1:] else ONE_S
        figure(what, f"{took_s:.1f} s", f"≤ {longest_s:.0f} s")
        late += [what] if took_s > longest_s else []
    assert not late


def seconds(call, *arguments):
    began_s = time.monotonic()
    call(*arguments)
    return time.monotonic() - began_s


def build(workspace):
    with started(Order(workspace, UNDERLAY, ("2",))) as (_, worker):
        return worker.ask(Question(BUILT.name))


def plain_build(workspace):
    shutil.rmtree(workspace / "build", ignore_errors=True)
    shutil.rmtree(workspace / "devel", ignore_errors=True)
    words = f". {UNDERLAY} && catkin_make -C {workspace}"
    subprocess.run(["bash", "-c", words], check=True, capture_output=True)


def check_3(workspace):
    (outcome,) = examine(Order(workspace, UNDERLAY, ("3",)))
    assert outcome.passed, outcome


@claim(
    "A check of an unchanged workspace in C++ takes 2 s more than in Python, its first build too"
)
def test_a_workspace_in_cpp(tmp_path, figure, monkeypatch):
    """Medians of pairs that take turns, because a busy machine slows both."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for name in ("literal", "literal_cpp"):
        shutil.copytree(LITERAL / name, tmp_path / name / "src")
    cpp, python = tmp_path / "literal_cpp", tmp_path / "literal"
    plain = shutil.copytree(cpp, tmp_path / "plain")
    times: dict[str, list[float]] = {}
    for turn in range(TIMES):
        shutil.rmtree(tmp_path / "cache", ignore_errors=True)
        calls = {
            "catkin_make": (plain_build, plain), "first build": (build, cpp),
            "3 in C++": (check_3, cpp), "3 in Python": (check_3, python),
        }  # fmt: skip
        for what, call in calls.items():
            times.setdefault(what, []).append(seconds(*call))
        with (cpp / "src/beginner_tutorials/src/talker.cpp").open("a") as file:
            file.write(f"// {turn}\n")
        times.setdefault("a changed file", []).append(seconds(build, cpp))
    medians = {what: statistics.median(values) for what, values in times.items()}
    late = []
    for what, base, most_s in (
        ("3 in C++", "3 in Python", CPP_MORE_S), ("first build", "catkin_make", BUILD_MORE_S),
        ("a changed file", "first build", 0.0),
    ):  # fmt: skip
        more_s = medians[what] - medians[base]
        figure(
            f"{what}: more than {base}",
            f"{more_s:.1f} s of {medians[what]:.1f}",
            f"≤ {most_s:.0f} s",
        )
        late += [what] if more_s > most_s else []
    assert not late, medians
