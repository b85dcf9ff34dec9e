"""The command line of ./tutorial check: a parser for each command, made of sets of options."""

from __future__ import annotations

import argparse
import os
from typing import Any, Callable, Iterable, Sequence

from node_kit.parameters.arguments import Parser
from tutorial_check.course.definition import HANDOUT, LANGUAGES, read_course
from tutorial_check.errors import CannotCheck
from tutorial_check.report.formats import FORMATS
from tutorial_check.report.memory import AGAIN, ALWAYS, NEVER

PROGRAM = "./tutorial check"
UNDERLAY = "TUTORIAL_UNDERLAY"  # environment variable: setup.bash of the underlay
WORKSPACE = "TUTORIAL_IN"  # environment variable: the workspace of a ./tutorial shell
CHECK = "check"  # the command without an option of its name
# {command: its sets of options}. If options name two commands, the later one here is run.
COMMANDS = {
    CHECK: ("workspace", "files", "exercises", "course", "language", "hints", "variant", "keep"),
    "watch": ("workspace", "watch", "exercises", "course", "language", "hints", "variant"),
    "solution": ("workspace", "solution", "exercises", "course"),
    "all": (
        "all",
        "exercises",
        "course",
        "language",
        "hints",
        "variant",
        "seed",
        "keep",
        "out",
        "jobs",
    ),
    "package": ("package", "exercises", "course", "language", "out"),
    "self-test": ("self-test", "course", "jobs"),
    "show-variant": ("show-variant", "course", "variant", "seed"),
}
ONE = "one workspace"  # what solution, watch and CHECK take
_Add = Callable[..., object]  # (set, *names, ...): add an option to a set, as argparse does


def path(word: str) -> str:
    """Return a path of the command line; an empty word would be the current folder."""
    if not word:
        raise argparse.ArgumentTypeError("an empty word is no path")
    return word


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Return the options, with their command; exit with a line if they are unclear."""
    command = _command_of(words)
    parser = _parser_of(COMMANDS[command])
    options, unknown = parser.parse_known_args(words)
    if unknown:
        parser.error(_misplaced(unknown[0], command))
    options.command = command
    try:
        options.course = read_course(options.course)
    except CannotCheck as error:
        parser.error(str(error))
    if not vars(options).get("workspace", command):
        exercises = " ".join(options.exercises)
        example = f"--in ~/ros/hydro/catkin_ws {exercises}".rstrip()
        parser.error(f"which workspace? For example: {example}")
    if command == "solution" and not options.exercises:
        parser.error("--solution of which exercise? For example: --solution 4.3")
    if not options.underlay:
        parser.error("--underlay is missing; ./tutorial check gives it")
    if "hints" in options and options.hints is None:
        options.hints = ALWAYS if command == "all" else AGAIN
    if "exercises" in options:
        options.exercises = _exercises_of(parser, options)
    return options


def _exercises_of(parser: Parser, options: argparse.Namespace) -> list[str]:
    """Return the chosen exercises, in the course's order."""
    known = options.course.exercises
    meant = [name for word in options.exercises for name in options.course.meant(word)]
    unknown = [name for name in meant if name not in known]
    if unknown:
        parser.error(f"no exercise {unknown[0]}; there are {', '.join(known)}")
    return [name for name in known if name in (meant or options.course.by_default)]


def _command_of(words: Sequence[str]) -> str:
    """Return the chosen command; if --help is given, print its help and exit."""
    parser = Parser(prog=PROGRAM, add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    for name in COMMANDS:
        if name != CHECK:
            parser.add_argument(f"--{name}", dest=name, nargs="?", const="")
    given = vars(parser.parse_known_args(words)[0])
    command = next((name for name in reversed(COMMANDS) if given.get(name) is not None), "")
    if given["help"]:
        _parser_of(COMMANDS.get(command) or _sets()).print_help()
        parser.exit()
    return command or CHECK


def _parser_of(names: Iterable[str]) -> Parser:
    what = "Checks the exercises of the tutorial in your own workspace."
    titles = (f"{name} ({exercise.title})" for name, exercise in read_course().exercises.items())
    usage, epilog = f"{PROGRAM} [-h] [OPTION ...] [EXERCISE ...]", f"exercises: {', '.join(titles)}"
    sets = _sets()
    parents = [sets[name] for name in names]
    return Parser(prog=PROGRAM, usage=usage, description=what, epilog=epilog, parents=parents)


def _users_of(options: str) -> str:
    """Return words for the commands that have a set of options."""
    users = [name for name, sets in COMMANDS.items() if options in sets]
    *others, last = dict.fromkeys(map(_words_of, users))
    return f"{', '.join(others)} and {last}" if others else last


def _words_of(command: str) -> str:
    return ONE if "workspace" in COMMANDS[command] else f"--{command}"


def _misplaced(word: str, command: str) -> str:
    """Return which command has an option that this one lacks."""
    option = word.partition("=")[0]
    names = (name for name, parser in _sets().items() if option in parser._option_string_actions)
    users = next(map(_users_of, names), "")
    if not users:
        return f"unrecognized arguments: {word}"
    chosen = ONE if command == CHECK else f"--{command}"
    return f"{option} is {'a command' if users == option else f'for {users}'}, not for {chosen}"


def _sets() -> dict[str, Parser]:
    """Return the sets of options, each below a heading with the commands that have it."""
    names = dict.fromkeys(name for sets in COMMANDS.values() for name in sets)
    sets = {name: Parser(add_help=False) for name in names}
    groups = {name: sets[name].add_argument_group(f"for {_users_of(name)}") for name in names}

    def add(name: str, *words: str, **about: Any) -> None:
        groups[name].add_argument(*words, **about)

    _add_shared(add)
    _add_of_one(add)
    return sets


def _add_of_one(add: _Add) -> None:
    """Add the options of a single command, or of those for one workspace."""
    what = "your catkin workspace, a folder of packages, or a zip; not needed in a shell of it"
    given = os.environ.get(WORKSPACE) or None
    about = {"dest": "workspace", "type": path, "default": given}
    add("workspace", "--in", **about, metavar="WORKSPACE", help=what)
    add("watch", "--watch", action="store_true", help="check again whenever a file is saved")
    what = "show our solutions of exercises that are done"
    add("solution", "--solution", action="store_true", help=what)
    for name, (what, _) in FORMATS.items():
        add("files", f"--{name}", type=path, metavar="FILE", help=f"write {what}")
    what = "for the professor: every workspace, or zip, in a folder"
    add("all", "--all", type=path, metavar="FOLDER", help=what)
    add("all", "--again", action="store_true", help="also what has not changed since last time")
    what = "check on the workers of a Dask scheduler, as tcp://HOST:8786"
    add("all", "--cluster", type=path, metavar="ADDRESS", help=what)
    what = "write the file for a service: gradescope, or github:OWNER/NAME (to --out)"
    add("package", "--package", type=path, metavar="SERVICE", help=what)
    what = "check the solutions of the course, right ones and wrong ones"
    add("self-test", "--self-test", action="store_true", help=what)
    what = "print the task sheet of a student"
    add("show-variant", "--show-variant", type=path, metavar="NAME", help=what)


def _add_shared(add: _Add) -> None:
    add("exercises", "exercises", nargs="*", metavar="EXERCISE", help="all, if none is given")
    what = "in place of the handout: wiki, or a folder with course.yaml and your own checks"
    add("course", "--course", type=path, default=str(HANDOUT), metavar="FOLDER", help=what)
    what = "of the programs: python, cpp (C++), or any: Python where there is a program in it"
    add("language", "--language", choices=LANGUAGES, default="", help=f"{what} (the course's)")
    what = "setup.bash of the underlay"
    given = os.environ.get(UNDERLAY)
    add("course", "--underlay", type=path, default=given, metavar="SETUP", help=what)
    what = "show how to fix it 0: never; 1: when the same mistake is made again; 2: always"
    add("hints", "--hints", type=int, choices=(0, 1, 2), help=f"{what} (1; with --all 2)")
    what = "the same as --hints 0"
    add("hints", "--no-hints", action="store_const", const=NEVER, dest="hints", help=what)
    what = "YAML of the values that differ, as --show-variant prints; or a folder of NAME.yaml"
    add("variant", "--variant", type=path, metavar="FILE", help=what)
    what = "draw each student's task from a seed and the name"
    add("seed", "--variants", metavar="SEED", help=what)
    what = "write what the programs did, as it was judged, to FOLDER/NAME.json"
    add("keep", "--keep", type=path, metavar="FOLDER", help=what)
    what = "where the table and the reports go (FOLDER/check), or the package"
    add("out", "--out", type=path, metavar="FOLDER", help=what)
    add("jobs", "--jobs", type=int, default=2, help="how many at a time (2)")
