"""The subcommands of ./tutorial, with their options, help and completion.

Needs no ROS, which may not be installed yet.
"""

from __future__ import annotations

import argparse
import sys
from typing import NoReturn, TextIO

from node_kit.parameters.arguments import Parser, above_zero
from tutorial_tools.command import ros2_programs
from tutorial_tools.command.downloads import FOXGLOVE, ROS2
from tutorial_tools.paths import REPOSITORY

SUBCOMMANDS = {  # name: (arguments as the help shows them, what it does)
    "demo": ("[--for SECONDS] [NAME:=VALUE ...]", "a recorded joystick drives the simulated robot"),
    "check": (
        "--in WORKSPACE [EXERCISE ...]",
        "which exercises are done in your workspace; --course wiki, or FOLDER: others",
    ),
    "ros2": ("[--yes] [PROGRAM ...]", "a Python program with ROS 2, beside ROS 1"),
    "foxglove": ("[--yes] [NAME:=VALUE ...]", "connect Foxglove or Lichtblick to the robots"),
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
WITHOUT_ASKING = "install what is missing ({} from PyPI) without asking"
HELP = {"-h", "--help"}
WITH_IN = ("shell", "run", "doctor", "check")  # subcommands that have --in
OWN_PARSER = {  # programs with parsers of their own: their options, for completion
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
# For bash, with the command as typed: ./tutorial in a clone, tutorial in its shell.
COMPLETION = """\
_tutorial() {
    local IFS=$'\\n'
    COMPREPLY=($("${COMP_WORDS[0]}" completion "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _tutorial tutorial ./tutorial"""


def tested() -> list[str]:
    """Return the packages that have tests."""
    folders = (REPOSITORY / "test").glob("*/*")
    return sorted({folder.parent.name for folder in folders if folder.name in KINDS})


def parser_of(word: str) -> Parser:
    """Return the parser of a subcommand's arguments."""
    arguments, text = SUBCOMMANDS[word]
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
        add("part", nargs="?", choices=("system", "workspace"), help="default: all")
    elif word == "test":
        parser.formatter_class = argparse.RawDescriptionHelpFormatter
        kinds = "\n".join(f"  {kind:10} {text}" for kind, text in KINDS.items())
        parser.epilog = f"kinds:\n{kinds}\n{MORE_OF_TEST}"
        text = "default: the first four kinds"
        add("kind", nargs="?", choices=[*KINDS, *tested()], metavar="KIND|PACKAGE|PATH", help=text)
        add("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    elif word == "run":
        add("rest", nargs=argparse.REMAINDER, metavar="COMMAND")
    elif word == "ros2":
        add("--yes", action="store_true", help=WITHOUT_ASKING.format(ROS2.size))
        text = f"a file, or one of ours: {', '.join(ros2_programs.programs())}; default: python"
        add("program", nargs="?", metavar="PROGRAM", help=text)
        add("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    elif word == "foxglove":
        add("--yes", action="store_true", help=WITHOUT_ASKING.format(FOXGLOVE.size))
        add("arguments", nargs="*", metavar="NAME:=VALUE", help="for foxglove_bridge.launch")
    elif word == "docs":
        add("folder", nargs="?", metavar="FOLDER", help="default: in the suite's cache")
    else:
        parser.usage = f"./tutorial {word} {arguments}"
    return parser


def show_help(file: TextIO) -> None:
    """Print the list of subcommands."""
    print("usage: ./tutorial COMMAND ...\n", file=file)
    for word, (arguments, text) in SUBCOMMANDS.items():
        print(f"  {f'{word} {arguments}':41} {text}", file=file)
        for kind, what in KINDS.items() if word == "test" else ():
            print(f"    {kind:39} {what}", file=file)
    print(f"\n{EPILOG}", file=file)


def fail(line: str) -> NoReturn:
    """Report a misuse in one line, and exit."""
    print(f"tutorial: {line}", file=sys.stderr)
    sys.exit(2)


def candidates(typed: list[str]) -> list[str]:
    """Return the completions of the last word; none leaves it to bash, which completes files."""
    word, *before, last = ["", *typed] if len(typed) == 1 else typed
    options = list(SUBCOMMANDS)
    if word:
        actions = parser_of(word)._actions if word in SUBCOMMANDS else []  # noqa: SLF001 (no other way)
        options = [option for action in actions for option in action.option_strings]
        options += OWN_PARSER.get(word, ())
        if not before:
            options += [choice for action in actions for choice in action.choices or ()]
    return [word for word in options if word.startswith(last) and (last or word[0] != "-")]
