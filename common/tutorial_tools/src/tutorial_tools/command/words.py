"""The words of ./tutorial, their options and help: prints the plan that the shell script follows.

Only the standard library, as ROS may not be installed yet. The plan is bash: the packages and
builds to set up, then the command to run.
"""

from __future__ import annotations

import argparse
import difflib
import os
import re
import shlex
import sys
from pathlib import Path
from typing import NoReturn, TextIO

from node_kit.arguments import above_zero
from tutorial_tools.command.build import REPOSITORY
from tutorial_tools.command.completion import SCRIPT, candidates
from tutorial_tools.command.set_up import is_done

SCRIPTS = REPOSITORY / "common" / "tutorial_tools" / "scripts"
PROGRAMS = {word: SCRIPTS / f"{word}.py" for word in ("demo", "join", "doctor")}
PROGRAMS["cockpit"] = REPOSITORY / "common" / "cockpit" / "scripts" / "cockpit.py"
PYTHON = "/usr/bin/python3"
PYPI = "pypi=python:test/requirements.txt"
WORDS = {  # word: (arguments as the help shows them, what it does)
    "demo": ("[--for SECONDS] [NAME:=VALUE ...]", "a recorded joystick drives the simulated robot"),
    "check": ("--in WORKSPACE [EXERCISE ...]", "which exercises are done in your workspace"),
    "test": ("[KIND] [ARGUMENT ...]", "run the tests: all, or those of one kind"),
    "cockpit": ("[--port PORT] [--lan]", "see and drive the robots in a browser"),
    "join": (
        "HOST NAME [NAME:=VALUE ...]",
        "drive robot NAME of the classroom on HOST",
    ),
    "doctor": ("[--in WORKSPACE]", "what to check when nothing moves"),
    "bench": ("[PACKAGE] [--hours HOURS]", "run the benchmarks: all, or those of one package"),
    "lint": ("[--fix]", "check the sources: types, style, layers, packages, shell scripts"),
    "docs": ("[FOLDER]", "build the documentation site from the pages"),
    "setup": ("[system|workspace]", "install and build what is missing: all, or one part"),
    "shell": ("[--in WORKSPACE]", "a shell in which all of this is found"),
    "run": ("[--in WORKSPACE] COMMAND ...", "one command in such a shell"),
    "completion": ("", 'completion for bash: eval "$(./tutorial completion)"'),
    "help": ("", "this list"),
}
KINDS = {  # of tests
    "unit": "seconds, no ROS running",
    "launch": "whether roslaunch can read each launch file",
    "ros": "rostests: all, of a folder of test/ros, or of files; --times N",
    "system": "./tutorial itself, workspaces, RViz on a virtual screen, two hosts",
    "again": "what failed of these, once more and alone",
    "kernel": "joy_node and Chromium with a joystick of a real kernel; minutes",
    "exercises": "the tests of check itself",
    "browser": "the cockpit's page in real browsers, which this installs",
    "containers": "docker/ on a Docker engine, which root starts if there is none; minutes",
    "faults": "random faults on the live system, --for SECONDS or --trials N: test/FAULTS.md",
    "mutation": "whether the unit tests notice small changes to the rules; hours",
}
IN_WORDS = ("shell", "run", "doctor", "check")  # which know --in
EPILOG = """\
--in WORKSPACE: your own catkin workspace in place of our beginner_tutorials and joy2twist, which
are then not found at all. `shell` and `run` make and build it if it does not exist.
Every command first sets up what it needs. The suite's own catkin workspaces are in
$TUTORIAL_WORKSPACE or else below ~/.cache; remove them, and they are built again.
README.md leads through the tutorial, section by section."""
CHOICE = re.compile(r"argument \S+: invalid choice: '(.*)' \(choose from (.*)\)")


class Parser(argparse.ArgumentParser):
    """Reports a mistake in one line."""

    def error(self, message: str) -> NoReturn:
        word, message = self.prog.split()[-1], message.replace(", NAME:=VALUE", "")
        wrong = CHOICE.fullmatch(message)
        if wrong:
            *others, last = wrong[2].replace("'", "").split(", ")
            message = f'"{wrong[1]}": must be {", ".join(others)} or {last}'
        self.exit(2, f"tutorial: {word}: {message}; ./tutorial {word} --help shows more\n")


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
        parser.epilog = f"kinds:\n{kinds}\nMore arguments go to pytest, such as -k EXPRESSION."
        add("kind", nargs="?", choices=KINDS, metavar="KIND", help="all of the first four if none")
        add("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    elif word == "run":
        add("rest", nargs=argparse.REMAINDER, metavar="COMMAND")
    else:
        parser.usage = f"./tutorial {word} {arguments}"
    return parser


def show_help(file: TextIO) -> None:
    """Print the list of words."""
    print("usage: ./tutorial COMMAND ...\n", file=file)
    for word, (arguments, text) in WORDS.items():
        print(f"  {f'{word} {arguments}':41} {text}", file=file)
        if word == "test":
            for kind, what in KINDS.items():
                print(f"    {kind:39} {what}", file=file)
    print(f"\n{EPILOG}", file=file)


def fail(line: str, code: int = 1) -> NoReturn:
    """Report a mistake in one line, and exit."""
    print(f"tutorial: {line}", file=sys.stderr)
    sys.exit(code)


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


def plan_of_test(kind: str | None, rest: list[str]) -> dict[str, list[str]]:
    """Return the plan of one kind of tests, or of all."""
    sections, programs, builds = ["demo", "more", "test"], [], ["workspace", PYPI]
    if kind in ("browser", "containers"):
        sections, programs = [*sections, "browser"], ["chromium", "chromedriver"]
    if kind == "mutation" and (REPOSITORY / "test/mutation/requirements.txt").exists():
        builds = [*builds, "pypi=mutation:test/mutation/requirements.txt"]
    command = [str(REPOSITORY / "test" / "run.py"), *filter(None, [kind]), *rest]
    return {"sections": sections, "programs": programs, "builds": builds, "command": command}


def plan_of_check(arguments: list[str]) -> dict[str, list[str]]:
    """Return the plan of the checker, which reads its options itself."""
    options = {argument.split("=")[0] for argument in arguments}
    if not os.environ.get("TUTORIAL_IN") and not options & {"--in", "--all", "-h", "--help"}:
        words = " ".join(["./tutorial check --in ~/ros/hydro/catkin_ws", *arguments])
        fail(f"check: which workspace? For example: {words}", 2)
    command = [PYTHON, "-m", "tutorial_check", *arguments]
    return {"sections": ["demo", "more"], "builds": ["workspace"], "command": command}


def plan_of_shell(word: str, command: list[str]) -> dict[str, list[str]]:
    """Return the plan of a shell, or of one command in it."""
    if word == "shell":
        rc = REPOSITORY / "common/tutorial_tools/etc/shellrc"
        command = ["bash", "--rcfile", str(rc), "-i"]
    builds = ["workspace", PYPI.replace("pypi", "maybe", 1)]
    return {"sections": ["demo", "more"], "builds": builds, "command": command}


def plan_of_tool(word: str, arguments: list[str]) -> dict[str, list[str]]:
    """Return the plan of bench, or of lint or docs: test/WORD with what it needs from PyPI."""
    _, rest = parser_of(word).parse_known_args(arguments)
    if word == "bench":
        if rest and not (REPOSITORY / "test/benchmark" / rest[0]).is_dir():
            fail(f'bench: "{rest[0]}" has no folder in test/benchmark')
        return plan_of_test("bench", rest)
    requirements = f"test/requirements-{word}.txt"
    made = plan_of_test(None, [])
    if (REPOSITORY / requirements).exists():
        made["builds"] = [*made["builds"], f"pypi={word}:{requirements}"]
    return {**made, "command": [str(REPOSITORY / "test" / word), *rest]}


def plan(word: str, arguments: list[str]) -> dict[str, list[str]]:
    """Return the lists of the plan: sections of packages, programs, builds and the command."""
    if word == "check":
        return plan_of_check(arguments)
    if word == "cockpit":  # which reads its options itself
        command = [str(PROGRAMS[word]), *arguments]
        return {"sections": ["demo", "more"], "builds": ["workspace"], "command": command}
    if word in ("bench", "lint", "docs"):
        return plan_of_tool(word, arguments)
    options = parser_of(word).parse_args(arguments)
    student = student_of(word, getattr(options, "student", None))
    if word in PROGRAMS:
        sections = ["doctor"] if word == "doctor" else ["demo", "more"]
        command = [str(PROGRAMS[word]), *([] if word == "doctor" else arguments)]
        made = {"sections": sections, "builds": ["workspace"], "command": command}
    elif word == "setup":
        made = {**plan_of_test(None, []), "command": []}
        made["sections"] = [] if options.part == "workspace" else made["sections"]
    elif word == "test":
        made = plan_of_test(options.kind, options.rest)
    else:
        made = plan_of_shell(word, command_of_run(options.rest) if word == "run" else [])
    if student:
        made.update(student=[student], builds=[*made["builds"], f"student={student}"])
    return made


def main() -> None:
    """Print the plan on file descriptor 3; without one, nothing is left to do."""
    workspace, word, *arguments = [*sys.argv[1:], ""] if len(sys.argv) == 2 else sys.argv[1:]
    if word == "":
        show_help(sys.stderr)
        sys.exit(2)
    if word in ("help", "-h", "--help"):
        show_help(sys.stdout)
    elif word == "completion":
        words = {name: parser_of(name) for name in WORDS}
        print("\n".join(candidates(words, KINDS, arguments)) if arguments else SCRIPT)
    elif word not in WORDS:
        near = difflib.get_close_matches(word, WORDS, 1)
        meant = f"; did you mean {near[0]}?" if near else ""
        fail(f'"{word}" is no command{meant}; ./tutorial help lists them')
    elif arguments[:1] == ["--in"] and word not in IN_WORDS:
        fail(f"{word}: knows no --in; shell, run, doctor and check do")
    else:
        made = plan(word, arguments)
        made["builds"] = [part for part in made["builds"] if not is_done(Path(workspace), part)]
        lines = [f"word={word} student={shlex.quote(''.join(made.get('student', [])))}"]
        for name in ("sections", "programs", "builds", "command"):
            lines.append(f"{name}=({' '.join(map(shlex.quote, made.get(name, [])))})")
        with open(3, "w", encoding="utf-8") as file:
            print("\n".join(lines), file=file)


if __name__ == "__main__":
    main()
