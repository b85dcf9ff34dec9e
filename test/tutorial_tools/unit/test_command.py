"""The words of ./tutorial: what each sets up and starts; mistakes, completion, the build."""

import os
import subprocess
from pathlib import Path

import pytest

from tutorial_testing.claims import claim
from tutorial_tools.command.downloads import FOXGLOVE, ROS2
from tutorial_tools.command.plans import plan, read
from tutorial_tools.command.subcommands import OWN_PARSER, candidates
from tutorial_tools.io.command import build
from tutorial_tools.io.command.environment import environment_of_help
from tutorial_tools.io.system import apt
from tutorial_tools.io.system.packages import packages
from tutorial_tools.rqt_windows import MODEL

SECTIONS = {"demo": ["demo", "more"], "test": ["demo", "more", "test"], "doctor": ["doctor"]}
SECTIONS["browser"] = [*SECTIONS["test"], "browser"]


@claim("Each word of `./tutorial` sets up and starts what its help says")
@pytest.mark.parametrize(("line", "sections", "program", "rest"), [
    ("join teacher robot_7 virtual:=true", "demo", "join.py", "teacher robot_7 virtual:=true"),
    ("check --in ws 4.3 --watch", "demo", "python3", "-m tutorial_check --in ws 4.3 --watch"),
    ("run rosrun joy2twist x.py _a:=1 -v", "demo", "rosrun", "joy2twist x.py _a:=1 -v"),
    ("doctor", "doctor", "doctor.py", ""),
    ("test exercises --every 5 --lf", "test", "run.py", "exercises --every 5 --lf"),
    ("test browser --trials 20", "browser", "run.py", "browser --trials 20"),
    ("bench joy2twist --hours 1", "test", "run.py", "bench joy2twist --hours 1"),
    ("bench check --hours 1", "test", "run.py", "bench tutorial_check --hours 1"),
    ("test joy2twist -k x", "test", "run.py", "joy2twist -k x"),
    ("test test/cockpit/browser -x", "browser", "run.py", "browser test/cockpit/browser -x"),
    ("test test/joy2twist", "test", "run.py", "joy2twist"),
    ("lint --fix", "test", "lint", "--fix"),
])  # fmt: skip
def test_what_a_word_sets_up_and_starts(monkeypatch, line, sections, program, rest):
    monkeypatch.delenv("TUTORIAL_IN", raising=False)
    word, *arguments = line.split()
    made = plan(word, arguments)
    first, *others = made["command"]
    assert made["sections"] == SECTIONS[sections]
    assert (os.path.basename(first), others) == (program, rest.split())
    assert made["builds"][0] == "workspace"
    assert "student" not in made


@claim("The bridge to Foxglove is installed after a question, and for tests; not by the set-up")
def test_what_installs_the_bridge_to_foxglove(monkeypatch, capsys):
    monkeypatch.setattr("platform.machine", lambda: "x86_64")
    monkeypatch.setattr("sys.version_info", (3, 11))
    asked = []
    words = ["foxglove", "--yes", "port:=9000"]
    made = read(Path("/w"), words, lambda *what: asked.append(what))
    assert asked == [(FOXGLOVE, True)]
    launch = ["roslaunch", "foxglove_bridge", "foxglove_bridge.launch", "port:=9000"]
    assert (made["command"], made["builds"][-1]) == (launch, FOXGLOVE.build)
    with pytest.raises(SystemExit):
        read(Path("/w"), ["foxglove"], lambda *_: int("nothing was installed"))
    assert "foxglove: " in capsys.readouterr().err
    builds = {word: plan(word, [])["builds"] for word in ("test", "bench", "setup", "lint")}
    with_it = {word for word in builds if FOXGLOVE.build in builds[word]}
    assert with_it == {"test", "bench"}


@claim("The bridge to Foxglove is installed ...", because="a real one needs nothing")
def test_a_real_bridge_to_foxglove_needs_no_question(tmp_path, monkeypatch):
    monkeypatch.setattr("tutorial_tools.command.plans.SHARE", tmp_path)
    (tmp_path / "foxglove_bridge").mkdir()
    (tmp_path / "foxglove_bridge" / "package.xml").touch()
    assert read(Path("/w"), ["foxglove"], lambda *_: 1 / 0)["builds"] == ["workspace"]


@claim("The bridge to Foxglove is installed ...", because="machines without wheels")
@pytest.mark.parametrize(("download", "machine", "python", "why"), [
    (FOXGLOVE, "aarch64", (3, 10), ""),
    (FOXGLOVE, "x86_64", (3, 9), "PyPI has no foxglove-sdk for x86_64 with Python 3.9, only for "
     "x86_64 and aarch64 with Python 3.10 to 3.14"),
    (FOXGLOVE, "riscv64", (3, 11), "PyPI has no foxglove-sdk for riscv64"),
    (ROS2, "aarch64", (3, 11), "with Python 3.10 to 3.14; or install ROS 2 itself"),
])  # fmt: skip
def test_where_pypi_has_no_wheels(download, machine, python, why):
    said = download.why_no_wheels(machine, python)
    assert bool(said) == bool(why)
    assert why in said


@claim("The help of check, cockpit, scheduler and worker is printed at once, with nothing built")
@pytest.mark.parametrize("word", OWN_PARSER)
def test_the_help_of_a_program_needs_nothing_built(word):
    made = plan(word, ["more", "--help"])
    assert (made["builds"], made["sections"]) == ([], SECTIONS["demo"])
    said = subprocess.check_output(made["command"], env=environment_of_help(), text=True)
    assert said.startswith("usage: ") and f"{word} [-h]" in said.splitlines()[0]


@claim("A student's workspace comes last, and what cannot be one is refused")
def test_a_students_workspace_is_absolute_and_built_last(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = plan("run", ["--in", "ws", "env", "--in", "x"])
    assert made["student"] == [f"{tmp_path}/ws"]
    assert made["builds"][-1] == f"student={tmp_path}/ws"
    assert made["command"] == ["env", "--in", "x"]
    monkeypatch.setenv("TUTORIAL_IN", "/mine")  # set by the calling shell
    assert plan("doctor", [])["student"] == ["/mine"]


@claim("A mistake in the words of `./tutorial` is one line with what to do")
@pytest.mark.parametrize(("line", "words"), [
    ("dmeo", '"dmeo" is no command; did you mean demo?'),
    *((f"demo --for {s}", f"--for: {s}: not a number above 0") for s in ("ever", "0", "nan")),
    ("demo --in /tmp", "demo: has no --in; shell, run, doctor and check do"),
    ("join teacher", "join: the following arguments are required: NAME"),
    ("test everything", 'test: "everything": must be unit, launch, ros, system, again'),
    ("bench moon", 'bench: "moon" has no folder test/moon/benchmark'),
    ("shell moon", "shell: unrecognized arguments: moon"),
    ("doctor --in /no/such", "doctor: --in /no/such: not a workspace, as it has no folder src"),
    ("run", "run: a command is missing"),
    ("run rosrun rviz rviz -d x", "run: no screen for RViz"),
    ("check 4.3", "For example: ./tutorial check --in ~/ros/hydro/catkin_ws 4.3"),
])  # fmt: skip
def test_a_mistake_is_one_line(monkeypatch, capsys, line, words):
    for name in ("DISPLAY", "TUTORIAL_IN"):
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(SystemExit) as end:
        read(Path("/ws"), line.split(), pytest.fail)
    (said,) = capsys.readouterr().err.splitlines()
    assert words in said and end.value.code == 2


def test_the_list_of_words_names_courses(capsys):
    assert read(Path("/ws"), ["--help"], pytest.fail) is None
    assert "workspace; --course wiki, or FOLDER: others\n" in capsys.readouterr().out


@claim("Words, kinds of tests and options complete in bash", because="all of them")
@pytest.mark.parametrize(("typed", "found"), [
    (["te"], ["test"]),
    (["test", "joy"], ["joy2twist"]),
    (["test", "unit", ""], []),  # bash completes files
    (["demo", "--"], ["--help", "--for"]),
])  # fmt: skip
def test_completion_of_words_kinds_and_options(typed, found):
    assert candidates(typed) == found


@claim("A student's workspace comes ...", because="what is refused")
@pytest.mark.parametrize(("folder", "why"), [
    ("a b", "without spaces"),
    ("package", "this is a package"),
    ("ws/src", "this is the src folder"),
    ("suite/joy2twist/ws", "the suite's own"),
    ("/proc/ws", "cannot be made"),
    ("/proc", "belongs to user 0, and you are 4321"),
])  # fmt: skip
def test_what_cannot_be_a_students_workspace(tmp_path, monkeypatch, folder, why):
    monkeypatch.setattr(build, "REPOSITORY", tmp_path / "suite")
    (tmp_path / "package").mkdir()
    (tmp_path / "package" / "package.xml").touch()
    (tmp_path / "ws" / "devel").mkdir(parents=True)
    monkeypatch.setattr(os, "geteuid", lambda: 4321)
    assert why in build.why_no_workspace(tmp_path / "cache", tmp_path / folder)


@claim("A real package that is installed later replaces its stand-in")
def test_all_is_built_again_when_a_real_package_came_and_not_after_a_test(tmp_path, monkeypatch):
    for name in ("common/stand_ins/joy/package.xml", f"{MODEL}/scripts/rqt_gui", "test/a/ros/b.py"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).touch()
    monkeypatch.setattr(build, "REPOSITORY", tmp_path)
    monkeypatch.setattr(build, "SHARE", tmp_path / "share")
    stamps = [build.stamp()]
    for folder in ("test/a", "test/a/ros"):
        (tmp_path / folder / "__pycache__").mkdir()
        (tmp_path / folder / "__pycache__" / "b.cpython-311.pyc").touch()
    assert build.stamp() == stamps[0] and build.real_packages() == []
    for name in ("test/a/ros/c.test", "share/joy/package.xml", "share/rqt_bag/package.xml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
        stamps.append(build.stamp())
    assert build.real_packages() == ["joy", "rqt_bag"]
    (tmp_path / MODEL / "scripts/rqt_gui").write_text("changed")  # generated packages have copies
    assert len({*stamps, build.stamp()}) == 5


def test_which_packages_belong_to_a_section(monkeypatch):
    monkeypatch.setenv("TUTORIAL_ROS", "/opt/ros/one")
    monkeypatch.setenv("TUTORIAL_WITHOUT", "test view")
    assert packages("demo", "test") == packages("demo") and "ros-one-ros-base" in packages("demo")
    assert "python3-distributed" in packages("cluster") and "ros-one-rviz" not in packages("more")


def test_apts_progress_in_steps_of_ten_percent():
    status = ["dlstatus:1:9.9:a", "dlstatus:2:31.5:a", "dlstatus:3:32:a", "pmerror:a:50:a"]
    assert [line.split()[1] for line in apt.progress(status, " of 2 MB")] == ["9", "31"]
