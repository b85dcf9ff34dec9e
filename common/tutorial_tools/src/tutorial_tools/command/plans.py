"""The plan of each subcommand of ./tutorial: what to set up, and what to run then."""

from __future__ import annotations

import difflib
import os
import platform
import sys
from pathlib import Path
from typing import Callable, Dict, List

from node_kit.ros2_python import installed
from tutorial_tools.command import ros2_programs, subcommands
from tutorial_tools.command.downloads import FOXGLOVE, ROS2, Download
from tutorial_tools.command.subcommands import HELP, OWN_PARSER, fail, parser_of
from tutorial_tools.paths import REPOSITORY, SHARE

SCRIPTS = REPOSITORY / "common" / "tutorial_tools" / "scripts"
PROGRAMS = {word: str(SCRIPTS / f"{word}.py") for word in ("demo", "join", "doctor")}
PROGRAMS["cockpit"] = str(REPOSITORY / "common" / "cockpit" / "scripts" / "cockpit.py")
PYPI = "python:test/requirements.txt"
CLUSTER = "--cluster"  # option of check --all
Plan = Dict[str, List[str]]  # sections of packages, builds, student and the command
# Asks whether to install a download, unless the argument says so; raises ValueError if not.
Confirm = Callable[[Download, bool], None]
BENCHES = {"check": "tutorial_check", "two_hosts": "suite"}  # former names


def with_kind(arguments: list[str]) -> list[str]:
    """Return the arguments of test, with the kind before a path in test, or a package."""
    folder, *below = Path(*arguments[:1]).parts or [""]
    if folder != "test":
        return arguments
    return [*below[1:2], *arguments] if below[1:] else [*below, *arguments[1:]]


def student_of(word: str, given: str | None) -> str:
    """Return the student's workspace, as an absolute path; "" without one."""
    if given is None:
        return os.environ.get("TUTORIAL_IN", "") if word == "doctor" else ""
    if not given:
        fail(f"--in: the workspace is missing, for example: ./tutorial {word} --in ~/catkin_ws")
    if word == "doctor" and not Path(given, "src").is_dir():
        fail(f"doctor: --in {given}: not a workspace, as it has no folder src")
    return os.path.realpath(given)


def command_of_run(command: list[str]) -> list[str]:
    """Return the command of `run`, unless it needs a screen that is missing."""
    if not command:
        fail("run: a command is missing, for example: ./tutorial run rostopic list")
    is_rviz = command[0] == "rviz" or command[:3] == ["rosrun", "rviz", "rviz"]
    if is_rviz and not os.environ.get("DISPLAY"):
        look = "without one, see the robot drive with: rostopic echo /odom/pose/pose/position"
        todo = f"call this in a terminal on a screen, or through ssh -X; {look}"
        fail(f"run: no screen for RViz, as DISPLAY is not set: {todo}")
    return command


def plan_of_test(kind: str, rest: list[str]) -> Plan:
    """Return the plan for a kind of tests, for all (""), or for lint, docs and bench."""
    made = {"sections": ["demo", "more", "test"], "builds": ["workspace", f"pypi={PYPI}"]}
    has_wheels = not FOXGLOVE.why_no_wheels(platform.machine(), sys.version_info[:2])
    if has_wheels and kind not in ("setup", "lint", "docs", "mutation"):
        made["builds"].append(FOXGLOVE.build)
    if kind in ("browser", "containers"):
        made["sections"].append("browser")
    if kind in ("lint", "docs"):
        made["builds"].append(f"pypi={kind}:test/requirements-{kind}.txt")
        return {**made, "command": [str(REPOSITORY / "test" / kind), *rest]}
    if kind == "ros2" and not installed():
        made["builds"].append(ROS2.build)
    if kind == "mutation":
        made["builds"].append("pypi=mutation:test/suite/mutation/requirements.txt")
    return {**made, "command": [str(REPOSITORY / "test/run.py"), *filter(None, [kind]), *rest]}


def options_of(arguments: list[str]) -> set[str]:
    """Return the options among arguments, without their values."""
    return {argument.split("=")[0] for argument in arguments if argument.startswith("-")}


def refuse(word: str, arguments: list[str]) -> None:
    """Refuse mistakes that would otherwise show only after minutes of set-up."""
    options = options_of(arguments)
    own = {"--in", "--all", "--self-test", "--package", "--show-variant"}
    named = os.environ.get("TUTORIAL_IN") or options & (own | HELP)
    if word == "check" and not named:
        words = " ".join(["./tutorial check --in ~/ros/hydro/catkin_ws", *arguments])
        fail(f"check: which workspace? For example: {words}")
    for given in arguments[:1]:
        if word == "bench" and not (REPOSITORY / "test" / given / "benchmark").is_dir():
            fail(f'bench: "{given}" has no folder test/{given}/benchmark')
        above = (Path(given), *Path(given).parents)
        if word == "docs" and any(path.exists() and not path.is_dir() for path in above):
            fail(f"docs: {given}: must be a folder, which is made if it does not exist")


def plan_of_ros2(workspace: Path, arguments: list[str], confirm: Confirm) -> Plan:
    """Return the plan for a program with ROS 2."""
    options = parser_of("ros2").parse_args(arguments)
    try:
        command = ros2_programs.command_of(workspace, options.program, options.rest)
        if not installed():
            confirm(ROS2, options.yes)
    except ValueError as error:
        fail(f"ros2: {error}")
    needed = [] if installed() else [ROS2.build]
    return {"sections": ["demo", "more"], "builds": ["workspace", *needed], "command": command}


def plan_of_foxglove(arguments: list[str], confirm: Confirm) -> Plan:
    """Return the plan for the bridge to Foxglove and Lichtblick: the real one, or ours."""
    options = parser_of("foxglove").parse_args(arguments)
    is_real = (SHARE / "foxglove_bridge" / "package.xml").exists()
    try:
        if not is_real:
            confirm(FOXGLOVE, options.yes)
    except ValueError as error:
        fail(f"foxglove: {error}")
    launch = ["roslaunch", "foxglove_bridge", "foxglove_bridge.launch", *options.arguments]
    builds = ["workspace", *([] if is_real else [FOXGLOVE.build])]
    return {"sections": ["demo", "more"], "builds": builds, "command": launch}


def plan_of_program(word: str, arguments: list[str]) -> Plan:
    """Return the plan of a subcommand with a parser of its own."""
    made: Plan = {"sections": ["demo", "more"], "builds": ["workspace"]}
    refuse(word, arguments)
    of_cluster = word in ("scheduler", "worker")
    module = f"tutorial_check.commands.{word}" if of_cluster else "tutorial_check"
    own = [PROGRAMS[word]] if word in PROGRAMS else ["/usr/bin/python3", "-m", module]
    if word in ("check", "worker"):  # a parser of C++
        made["builds"].append(f"maybe={PYPI}")
    if HELP & options_of(arguments):
        made["builds"] = []
    elif of_cluster or CLUSTER in options_of(arguments):
        made["sections"].append("cluster")
    return {**made, "command": [*own, *arguments]}


def plan(word: str, arguments: list[str]) -> Plan:
    """Return the plan of a subcommand."""
    made: Plan = {"sections": ["demo", "more"], "builds": ["workspace"]}
    if word in OWN_PARSER:
        return plan_of_program(word, arguments)
    if word == "bench":
        arguments = [BENCHES.get(argument, argument) for argument in arguments]
    if word in ("bench", "lint", "docs"):
        parsed = parser_of(word).parse_known_args(arguments)
        if word == "docs" and parsed[1]:
            parser_of(word).error(f"unrecognized arguments: {' '.join(parsed[1])}")
        refuse(word, arguments)
        return plan_of_test(word, arguments)
    arguments = with_kind(arguments) if word == "test" else arguments
    options = parser_of(word).parse_args(arguments)
    student = student_of(word, getattr(options, "student", None))
    if word == "doctor":
        made.update(sections=["doctor"], command=[PROGRAMS[word]])
    elif word in PROGRAMS:
        made["command"] = [PROGRAMS[word], *arguments]
    elif word in ("setup", "test"):
        made = plan_of_test(*((options.kind or "", options.rest) if word == "test" else (word, [])))
        if word == "setup":
            made["command"] = []
            made["sections"] = [] if options.part == "workspace" else made["sections"]
    else:
        rc = REPOSITORY / "common/tutorial_tools/etc/shellrc"
        shell = ["bash", "--rcfile", str(rc), "-i"]
        made["command"] = command_of_run(options.rest) if word == "run" else shell
        made["builds"].append(f"maybe={PYPI}")
    if student:
        made.update(student=[student], builds=[*made["builds"], f"student={student}"])
    return made


def read(workspace: Path, typed: list[str], confirm: Confirm) -> Plan | None:
    """Return the plan for what the user typed; None if nothing is left to do. Exits at a misuse."""
    word, arguments = "".join(typed[:1]), typed[1:]
    if word == "":
        subcommands.show_help(sys.stderr)
        sys.exit(2)
    if word in {"help", *HELP}:
        subcommands.show_help(sys.stdout)
        return None
    if word == "completion":
        print("\n".join(subcommands.candidates(arguments)) if arguments else subcommands.COMPLETION)
        return None
    if word not in subcommands.SUBCOMMANDS:
        near = difflib.get_close_matches(word, subcommands.SUBCOMMANDS, 1)
        meant = f"; did you mean {near[0]}?" if near else ""
        fail(f'"{word}" is no command{meant}; ./tutorial help lists them')
    if arguments[:1] == ["--in"] and word not in subcommands.WITH_IN:
        fail(f"{word}: has no --in; shell, run, doctor and check do")
    if word == "ros2":
        return plan_of_ros2(workspace, arguments, confirm)
    if word == "foxglove":
        return plan_of_foxglove(arguments, confirm)
    return plan(word, arguments)
