"""The command line, ./tutorial check; one workspace, checked once or whenever a file is saved."""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import signal
import stat
import sys
import time
from pathlib import Path
from typing import NoReturn, Sequence

from node_kit.arguments import Parser
from tutorial_check.checking.examination import examine
from tutorial_check.checking.results import Outcome
from tutorial_check.commands.package import package
from tutorial_check.commands.self_test import self_test
from tutorial_check.course.definition import HANDOUT, read_course
from tutorial_check.course.tasks import sheet, variant_of
from tutorial_check.processes.errors import CannotCheck, fault
from tutorial_check.report.formats import FORMATS, clear, keep, without_hints, write
from tutorial_check.report.memory import AGAIN, ALWAYS, Memory, show_solution
from tutorial_check.report.text import Terminal, summary
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.handed_in import all_below
from tutorial_check.submission.order import Order

PERIOD_S = 0.5  # between two looks; editors save in several steps, so two must be the same
OF_EDITORS = ("~", ".swp")
UNDERLAY = "TUTORIAL_UNDERLAY"  # environment variable: setup.bash of the underlay
WORKSPACE = "TUTORIAL_IN"  # environment variable: the workspace of the shell that this is called in


def path(word: str) -> str:
    """Return a path of the command line; an empty word would be the current folder."""
    if not word:
        raise argparse.ArgumentTypeError("an empty word is no path")
    return word


MODES = ("workspace", "all", "package", "self_test", "show_variant")


def _parser() -> Parser:
    what = "Checks the exercises of the tutorial in your own workspace."
    known = ", ".join(f"{name} ({one.title})" for name, one in read_course().exercises.items())
    parser = Parser(prog="./tutorial check", description=what, epilog=f"exercises: {known}")
    where, add = parser.add_mutually_exclusive_group(), parser.add_argument
    what = "your catkin workspace, a folder of packages, or a zip; in a shell of it not needed"
    where.add_argument("--in", dest="workspace", type=path, metavar="WORKSPACE", help=what)
    parser.set_defaults(workspace=os.environ.get(WORKSPACE) or None)
    what = "for the professor: every workspace, or zip, in a folder"
    where.add_argument("--all", type=path, metavar="FOLDER", help=what)
    what = "write what a service takes: gradescope, or github:OWNER/NAME (to --out)"
    where.add_argument("--package", type=path, metavar="SERVICE", help=what)
    add("exercises", nargs="*", metavar="EXERCISE", help="all of the handout without one")
    what = "in place of the handout: wiki, or a folder with course.yaml and your own checks"
    add("--course", type=path, default=str(HANDOUT), metavar="FOLDER", help=what)
    what = "check the solutions of the course, right ones and wrong ones"
    where.add_argument("--self-test", action="store_true", help=what)
    what = "0: say what is wrong, never how to fix it; 1: when the same is wrong again; 2: always"
    add("--hints", type=int, choices=(0, 1, 2), help=f"{what} (1; with --all 2)")
    add("--no-hints", action="store_const", const=0, dest="hints", help="the same as --hints 0")
    what = "YAML of what differs from the course, as --show-variant prints; or folder of NAME.yaml"
    add("--variant", type=path, metavar="FILE", help=what)
    what = "with --all: draw each student's from a seed and name"
    add("--variants", metavar="SEED", help=what)
    what = "print the task sheet of a student"
    where.add_argument("--show-variant", type=path, metavar="NAME", help=what)
    add("--solution", action="store_true", help="show ours, of exercises that are done")
    add("--watch", action="store_true", help="check again whenever a file is saved")
    for name, (what, _) in FORMATS.items():
        add(f"--{name}", type=path, metavar="FILE", help=f"write {what}")
    what = "write what the programs did, by which it was judged, to FOLDER/NAME.json"
    add("--keep", type=path, metavar="FOLDER", help=what)
    what = "with --all: where the table and the reports go (FOLDER/check)"
    add("--out", type=path, metavar="FOLDER", help=what)
    add("--again", action="store_true", help="with --all: also what is the same as last time")
    what = "with --all: check on the workers of a Dask scheduler, as tcp://HOST:8786"
    add("--cluster", type=path, metavar="ADDRESS", help=what)
    add("--jobs", type=int, help="with --all: how many at a time (2)")
    what = "setup.bash of what the exercises need"
    add("--underlay", type=path, default=os.environ.get(UNDERLAY), metavar="SETUP", help=what)
    return parser


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """Return the options; end with a line if they are not clear."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        options.course = read_course(options.course)
    except CannotCheck as error:
        parser.error(str(error))
    known = options.course.exercises
    if not any(getattr(options, name) for name in MODES):
        words = " ".join(options.exercises)
        parser.error(f"which workspace? For example: --in ~/ros/hydro/catkin_ws {words}".rstrip())
    wanted = [name for each in options.exercises for name in options.course.meant(each)]
    unknown = [each for each in wanted if each not in known]
    if unknown:
        parser.error(f"no exercise {unknown[0]}; there are {', '.join(known)}")
    _refuse_idle(parser, options)
    options.jobs = 2 if options.jobs is None else options.jobs
    if options.hints is None:
        options.hints = ALWAYS if options.all else AGAIN
    if not options.underlay:
        parser.error("--underlay is missing; ./tutorial check gives it")
    # In the course's order, whatever theirs.
    wanted = wanted or options.course.by_default
    options.exercises = [each for each in known if each in wanted]
    return options


def _refuse_idle(parser: argparse.ArgumentParser, given: argparse.Namespace) -> None:
    """End with a line if an option would do nothing."""
    file = next((f"--{name}" for name in FORMATS if getattr(given, name)), "")
    checks_many = given.all or given.self_test
    rows = (
        (given.watch and given.all, "--watch is for one workspace"),
        (given.solution and (checks_many or given.watch),
         "--solution is for one workspace, and checks nothing"),
        (given.solution and not given.exercises,
         "--solution of which exercise? For example: --solution 4.3"),
        (file and given.all, f"{file} is for one workspace; --all writes a .json of each student"),
        (file and given.watch, f"{file} is for one check; leave --watch out"),
        (given.keep and (given.watch or given.solution or given.package or given.self_test),
         "--keep is for workspaces that are checked once"),
        (given.again and not given.all, "--again is for --all"),
        (given.cluster and not given.all, "--cluster is for --all"),
        (given.out is not None and not (given.all or given.package), "--out is for --all"),
        (given.jobs is not None and not checks_many, "--jobs is for --all"),
        (given.variant and (given.package or given.self_test), "--variant is for workspaces"),
        (given.variant and os.path.isdir(given.variant) and not (given.all or given.show_variant),
         "--variant FOLDER is for --all and --show-variant"),
        (given.variants is not None and not (given.all or given.show_variant),
         "--variants is for --all and --show-variant"),
    )  # fmt: skip
    for is_idle, why in rows:
        if is_idle:
            parser.error(why)


def check_one(options: argparse.Namespace) -> int:
    """Do what was asked for with a workspace; return the exit code. Raises CannotCheck."""
    files = {name: getattr(options, name) for name in FORMATS if getattr(options, name)}
    for file in files.values():
        clear(file)
    if options.solution:
        memory = Memory(options.workspace, options.course, options.hints)
        show_solution(options.course, options.exercises, memory)
        return 0
    outcomes = _look(options)
    print(f"{summary(outcomes)} in {os.path.abspath(options.workspace)}")
    handed_out = without_hints(outcomes) if options.hints == 0 else outcomes
    if options.keep:
        name = os.path.basename(os.path.abspath(options.workspace))
        keep(options.keep, name, handed_out)
    _write_files(files, handed_out)
    if any(outcome.trouble for outcome in outcomes):
        return 2
    return int(not all(outcome.passed for outcome in outcomes))


def _look(options: argparse.Namespace, only_first: bool = False) -> list[Outcome]:
    """Examine, print and remember what comes of it. only_first: end at the first that is wrong."""
    memory = Memory(options.workspace, options.course, options.hints)
    terminal = Terminal(memory.hint_of, only_first)
    terminal.busy("copying and preparing ...")
    try:
        order = Order(
            Path(options.workspace), options.underlay, options.exercises, only_first,
            is_callers_own=not (options.gradescope or options.classroom),
            course=options.course.folder, variant=variant_of(options.course, options, ""),
        )  # fmt: skip
        outcomes = examine(order, terminal.result, side_by_side=order.is_callers_own)
    finally:
        terminal.busy("")
    for one in outcomes:
        if one.trouble:
            print(f"check: {one.id}: no verdict: {one.trouble}", file=sys.stderr)
    memory.keep(outcomes)
    return outcomes


def _write_files(files: dict[str, str], outcomes: list[Outcome]) -> None:
    """Write the files, each though another cannot be written. Raises CannotCheck."""
    faults = []
    for name, file in files.items():
        try:
            if name == "classroom" and any(outcome.trouble for outcome in outcomes):
                # It has no word for this. Without a file it reports an error, and no points.
                why = "not every exercise has a verdict"
                print(f"check: {file} is not written: {why}", file=sys.stderr)
            else:
                write(file, FORMATS[name][1](outcomes))
        except CannotCheck as error:
            faults.append(str(error))
    if faults:
        raise CannotCheck("; ".join(faults))


def stamps(folder: str) -> dict[str, tuple[int, int]]:
    """Return {path: (time of the last change, also of rights; size)} of a student's files."""
    found = {}
    for path in all_below(folder):
        with contextlib.suppress(OSError):  # removed meanwhile
            about = os.stat(path)
            if not (stat.S_ISDIR(about.st_mode) or path.endswith(OF_EDITORS)):
                found[path] = about.st_ctime_ns, about.st_size
    return found


def watch(options: argparse.Namespace) -> NoReturn:
    """Until Ctrl-C: look, report the first that is wrong, wait for a change. Raises CannotCheck."""
    if not os.path.isdir(options.workspace):
        raise CannotCheck(f"{options.workspace}: no folder, and --watch is for one")
    while True:
        before = stamps(options.workspace)
        print("\x1b[2J\x1b[H" if sys.stdout.isatty() else "", end="")
        try:
            outcomes = _look(options, only_first=True)
        except CannotCheck as error:
            print(f"check: {fault(error)}")  # half-saved, or a folder that is just being moved
        else:
            solved = ", ".join(one.id for one in outcomes if one.solved)
            all_passed = all(outcome.passed for outcome in outcomes)
            print(summary(outcomes) if all_passed else f"done: {solved or 'none yet'}")
        print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
        last = now = before
        while now == before or now != last:  # and then nothing changes for a moment
            time.sleep(PERIOD_S)
            last, now = now, stamps(options.workspace)


def _run(options: argparse.Namespace) -> int:
    course = options.course
    if options.all:
        from tutorial_check.commands.check_all import check_all  # noqa: PLC0415  takes its time

        return check_all(options)
    if options.self_test:
        return self_test(course, options.underlay, max(1, options.jobs))
    if options.watch:
        watch(options)
    if options.package:
        print(package(options.package, course, options.exercises, options.out))
    elif options.show_variant:
        name = options.show_variant
        print(sheet(course, variant_of(course, options, name), name))
    else:
        return check_one(options)
    return 0


def main() -> None:
    """Run the command. Exit code 0: nothing wrong; 1: something is; 2: the checker cannot work."""
    assert isinstance(sys.stdout, io.TextIOWrapper)
    sys.stdout.reconfigure(errors="backslashreplace")  # for names of files that are no UTF-8
    options = parse(sys.argv[1:])
    for number in (signal.SIGTERM, signal.SIGHUP):  # as Ctrl-C: what was started ends, too
        if signal.getsignal(number) != signal.SIG_IGN:  # as nohup has it
            signal.signal(number, signal.default_int_handler)
    for line in bubblewrap.lacking():
        print(f"check: {line}", file=sys.stderr, flush=True)
    try:
        code = _run(options)
    except CannotCheck as error:
        print(f"\ncheck: no verdict: {fault(error)}", file=sys.stderr)
        code = 2
    except BrokenPipeError:  # The reader, as head, has seen enough.
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  for what is unwritten
        code = 2
    except Exception as error:  # not the student's fault, whatever it is
        print(f"\ncheck: {fault(error)}", file=sys.stderr)
        print("check: this is a fault of the check, not of your exercises", file=sys.stderr)
        code = 2
    except KeyboardInterrupt:
        if not options.watch:
            print("\ncheck: interrupted: no verdict", file=sys.stderr)
        code = 130
    sys.exit(code)
