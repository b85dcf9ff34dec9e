"""The words of ./tutorial, their options and help, and the plan of each: what to set up and to run.

Only the standard library, as ROS may not be installed yet.
"""

from __future__ import annotations

import argparse
import difflib
import os
import sys
from pathlib import Path
from typing import Dict, List, NoReturn, TextIO

from node_kit.parameters.arguments import Parser, above_zero
from node_kit.ros2_python import installed
from tutorial_tools.io.command import ros2
from tutorial_tools.io.command.build import REPOSITORY

SCRIPTS = REPOSITORY / "common" / "tutorial_tools" / "scripts"
PROGRAMS = {word: str(SCRIPTS / f"{word}.py") for word in ("demo", "join", "doctor")}
PROGRAMS["cockpit"] = str(REPOSITORY / "common" / "cockpit" / "scripts" / "cockpit.py")
PYPI = "python:test/requirements.txt"
WORDS = {  # word: (arguments as the help shows them, what it does)
    "demo": ("[--for SECONDS] [NAME:=VALUE ...]", "a recorded joystick drives the simulated robot"),
    "check": (
        "--in WORKSPACE [EXERCISE ...]",
        "which exercises are done in your workspace; --course wiki, or FOLDER: others",
    ),
    "ros2": ("[--yes] [PROGRAM ...]", "a Python program with ROS 2, beside ROS 1"),
    "scheduler": ("[--host HOST]", "distribute what check --all --cluster is to check"),
    "worker": ("ADDRESS [--jobs N]", "check for such a scheduler"),
    "test": ("[KIND|PACKAGE|PATH] [ARGUMENT ...]", "run the tests: all, or some of them"),
    "cockpit": ("[--port PORT] [--lan]", "see and drive the robots in a browser"),
    "join": ("HOST NAME [NAME:=VALUE ...]", "drive robot NAME of the classroom on HOST"),
    "doctor": ("[--in WORKSPACE]", "what to check when nothing moves"),
    "bench": ("[PACKAGE]", "run the benchmarks: all, or those of one package"),
    "lint": ("[--fix]", "check the sources: types, style, layers, packages, shell scripts"),
    "docs": ("[FOLDER]", "build the documentation site from the pages"),
    "setup": ("[system|workspace]", "install and build what is missing: all, or one part"),
    "shell": ("[--in WORKSPACE]", "a shell in which all of this is found"),
    "run": ("[--in WORKSPACE] COMMAND ...", "one command in such a shell"),
    "completion": ("", 'completion for bash: eval "$(./tutorial completion)"'),
    "help": ("", "this list"),
}
KINDS = {  # kinds of tests
    "unit": "seconds, no ROS running",
    "launch": "whether roslaunch can read each launch file",
    "ros": "rostests; --times N",
    "system": "./tutorial itself, workspaces, RViz on a virtual screen, two hosts",
    "again": "what failed of these, once more and alone",
    "kernel": "joy_node with a joystick of a real kernel; minutes",
    "exercises": "the tests of check itself",
    "ros2": "the bridge and the programs of ROS 2, which this installs",
    "browser": "the cockpit's page in real browsers, which this installs",
    "containers": "docker/ on a Docker engine, which root starts if there is none; minutes",
    "faults": "random faults on the live system, --for SECONDS or --trials N: test/FAULTS.md",
    "mutation": "whether the unit tests notice small changes to the rules; hours",
}
MORE_OF_TEST = """\
PACKAGE, such as joy2twist: its tests of the first four kinds, without those marked long or night.
PATH: a folder or file of test/PACKAGE/KIND. More arguments go to pytest, such as -k EXPRESSION."""
CLUSTER = "--cluster"  # option of check --all
HELP = {"-h", "--help"}
IN_WORDS = ("shell", "run", "doctor", "check")  # which know --in
OWN_PARSER = {  # programs that read their options themselves, and those for completion
    "check": ("--in", "--all", "--watch", "--hints", "--solution", "--course", "--self-test"),
    "cockpit": ("--port", "--lan"),
    "scheduler": ("--host",),
    "worker": ("--jobs", "--not-isolated"),
}
EPILOG = """\
--in WORKSPACE: your own catkin workspace in place of our beginner_tutorials and joy2twist, which
are then not found at all. `shell` and `run` make and build it if it does not exist.
Every command first sets up what it needs. The suite's own catkin workspaces are in
$TUTORIAL_WORKSPACE or else below ~/.cache; remove them, and they are built again.
common/doc/TUTORIAL.md leads through it, section by section."""
# For bash. The name is that of the command line: ./tutorial from a clone, tutorial in its shell.
COMPLETION = """\
_tutorial() {
    local IFS=$'\\n'
    COMPREPLY=($("${COMP_WORDS[0]}" completion "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _tutorial tutorial ./tutorial"""
Plan = Dict[str, List[str]]  # sections of packages, builds, student and the command


def tested() -> list[str]:
    """Return the packages that have tests."""
    folders = (REPOSITORY / "test").glob("*/*")
    return sorted({folder.parent.name for folder in folders if folder.name in KINDS})


def with_kind(arguments: list[str]) -> list[str]:
    """Return the arguments of test with its kind before a path in test, or with its package."""
    folder, *below = Path(*arguments[:1]).parts or [""]
    if folder != "test":
        return arguments
    return [*below[1:2], *arguments] if below[1:] else [*below, *arguments[1:]]


def parser_of(word: str) -> Parser:
    """Return the parser of one word's arguments."""
    arguments, text = WORDS[word]
    parser = Parser(prog=f"./tutorial {word}", description=text, allow_abbrev=False)
    add = parser.add_argument
    if word in ("shell", "run", "doctor"):
        add("--in", dest="student", metavar="WORKSPACE", help="your own catkin workspace")
    if word == "demo":
        text = "end after this time, with a line on the drive; exit code 0 if the robot moved"
        add("--for", dest="duration_s", type=above_zero, metavar="SECONDS", help=text)
        add("arguments", nargs="*", metavar="NAME:=VALUE", help="for launch_bag.launch")
    elif word == "join":
        add("host", metavar="HOST", help="the teacher's machine, or HOST:PORT")
        add("name", metavar="NAME", help="of the robot, such as robot_7")
        text = "for student.launch, such as virtual:=true or joystick:=browser"
        add("arguments", nargs="*", metavar="NAME:=VALUE", help=text)
    elif word == "setup":
        add("part", nargs="?", choices=("system", "workspace"), help="all without one")
    elif word == "test":
        parser.formatter_class = argparse.RawDescriptionHelpFormatter
        kinds = "\n".join(f"  {kind:10} {text}" for kind, text in KINDS.items())
        parser.epilog = f"kinds:\n{kinds}\n{MORE_OF_TEST}"
        text = "all of the first four kinds if none"
        add("kind", nargs="?", choices=[*KINDS, *tested()], metavar="KIND|PACKAGE|PATH", help=text)
        add("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    elif word == "run":
        add("rest", nargs=argparse.REMAINDER, metavar="COMMAND")
    elif word == "ros2":
        text = f"install what is missing ({ros2.SIZE} from PyPI) without asking"
        add("--yes", action="store_true", help=text)
        text = f"a file, or one of ours: {', '.join(ros2.programs())}; none: python itself"
        add("program", nargs="?", metavar="PROGRAM", help=text)
        add("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    elif word == "docs":
        add("folder", nargs="?", metavar="FOLDER", help="of the site; in the suite's cache if none")
    else:
        parser.usage = f"./tutorial {word} {arguments}"
    return parser


def show_help(file: TextIO) -> None:
    """Print the list of words."""
    print("usage: ./tutorial COMMAND ...\n", file=file)
    for word, (arguments, text) in WORDS.items():
        print(f"  {f'{word} {arguments}':41} {text}", file=file)
        for kind, what in KINDS.items() if word == "test" else ():
            print(f"    {kind:39} {what}", file=file)
    print(f"\n{EPILOG}", file=file)


def fail(line: str) -> NoReturn:
    """Report a misuse in one line, and exit."""
    print(f"tutorial: {line}", file=sys.stderr)
    sys.exit(2)


def student_of(word: str, given: str | None) -> str:
    """Return the student's workspace, as an absolute path; "" without one."""
    if given is None:
        return os.environ.get("TUTORIAL_IN", "") if word == "doctor" else ""
    if not given:
        fail(f"--in: the workspace is missing, for example: ./tutorial {word} --in ~/catkin_ws")
    if word == "doctor" and not Path(given, "src").is_dir():
        fail(f"doctor: --in {given}: no workspace, it has no folder src")
    return os.path.realpath(given)


def command_of_run(command: list[str]) -> list[str]:
    """Return the command of the word run, if it can be run here."""
    if not command:
        fail("run: a command is missing, for example: ./tutorial run rostopic list")
    is_rviz = command[0] == "rviz" or command[:3] == ["rosrun", "rviz", "rviz"]
    if is_rviz and not os.environ.get("DISPLAY"):
        look = "without one, see the robot drive with: rostopic echo /odom/pose/pose/position"
        todo = f"call this in a terminal on a screen, or through ssh -X; {look}"
        fail(f"run: no screen for RViz, as DISPLAY is not set: {todo}")
    return command


def plan_of_test(kind: str, rest: list[str]) -> Plan:
    """Return the plan of one kind of tests, of all (""), or of what else needs their packages."""
    made = {"sections": ["demo", "more", "test"], "builds": ["workspace", f"pypi={PYPI}"]}
    if kind in ("browser", "containers"):
        made["sections"].append("browser")
    if kind in ("lint", "docs"):
        made["builds"].append(f"pypi={kind}:test/requirements-{kind}.txt")
        return {**made, "command": [str(REPOSITORY / "test" / kind), *rest]}
    if kind == "ros2" and not installed():
        made["builds"].append(ros2.BUILD)
    if kind == "mutation":
        made["builds"].append("pypi=mutation:test/suite/mutation/requirements.txt")
    return {**made, "command": [str(REPOSITORY / "test/run.py"), *filter(None, [kind]), *rest]}


def options_of(arguments: list[str]) -> set[str]:
    """Return the options among arguments, without their values."""
    return {argument.split("=")[0] for argument in arguments if argument.startswith("-")}


def refuse(word: str, arguments: list[str]) -> None:
    """Refuse what would fail only after a set-up of minutes."""
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


def plan_of_ros2(workspace: Path, arguments: list[str]) -> Plan:
    """Return the builds and the command of a program with ROS 2."""
    options = parser_of("ros2").parse_args(arguments)
    try:
        command = ros2.command_of(workspace, options.program, options.rest)
        ros2.must_be_possible(workspace, options.yes)
    except ValueError as error:
        fail(f"ros2: {error}")
    needed = [] if installed() else [ros2.BUILD]
    return {"sections": ["demo", "more"], "builds": ["workspace", *needed], "command": command}


def plan(word: str, arguments: list[str]) -> Plan:
    """Return the plan of a word."""
    made: Plan = {"sections": ["demo", "more"], "builds": ["workspace"]}
    if word in OWN_PARSER:
        refuse(word, arguments)
        of_cluster = word in ("scheduler", "worker")
        module = f"tutorial_check.commands.{word}" if of_cluster else "tutorial_check"
        own = [PROGRAMS[word]] if word in PROGRAMS else ["/usr/bin/python3", "-m", module]
        if HELP & options_of(arguments):
            made["builds"] = []
        elif of_cluster or CLUSTER in options_of(arguments):
            made["sections"].append("cluster")
        return {**made, "command": [*own, *arguments]}
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
        made = plan_of_test(*((options.kind or "", options.rest) if word == "test" else ("", [])))
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


def candidates(typed: list[str]) -> list[str]:
    """Return what the last typed word may become; nothing leaves it to bash, as for files."""
    word, *before, last = ["", *typed] if len(typed) == 1 else typed
    found = list(WORDS)
    if word:
        actions = parser_of(word)._actions if word in WORDS else []  # noqa: SLF001 (no other way)
        found = [option for action in actions for option in action.option_strings]
        found += OWN_PARSER.get(word, ())
        found += [] if before else [one for action in actions for one in action.choices or ()]
    return [each for each in found if each.startswith(last) and (last or each[0] != "-")]


def read(workspace: Path, typed: list[str]) -> Plan | None:
    """Return the plan of what the user typed; None if nothing is left to do. A misuse exits."""
    word, arguments = "".join(typed[:1]), typed[1:]
    if word == "":
        show_help(sys.stderr)
        sys.exit(2)
    if word in {"help", *HELP}:
        show_help(sys.stdout)
        return None
    if word == "completion":
        print("\n".join(candidates(arguments)) if arguments else COMPLETION)
        return None
    if word not in WORDS:
        near = difflib.get_close_matches(word, WORDS, 1)
        meant = f"; did you mean {near[0]}?" if near else ""
        fail(f'"{word}" is no command{meant}; ./tutorial help lists them')
    if arguments[:1] == ["--in"] and word not in IN_WORDS:
        fail(f"{word}: knows no --in; shell, run, doctor and check do")
    return plan_of_ros2(workspace, arguments) if word == "ros2" else plan(word, arguments)
