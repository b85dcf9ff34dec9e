"""./tutorial check: run the chosen command, and report why it cannot work."""

from __future__ import annotations

import argparse
import io
import os
import signal
import sys
from typing import Callable

from tutorial_check.commands.check import check
from tutorial_check.commands.check_all import check_all
from tutorial_check.commands.options import CHECK, parse
from tutorial_check.commands.package import package
from tutorial_check.commands.self_test import self_test
from tutorial_check.commands.watch import watch
from tutorial_check.course.tasks import sheet, variant_of
from tutorial_check.errors import CannotCheck, fault
from tutorial_check.report.memory import NEVER, Memory, show_solution
from tutorial_check.sandbox import bubblewrap


def _package(options: argparse.Namespace) -> int:
    print(
        package(options.package, options.course, options.exercises, options.out, options.language)
    )
    return 0


def _self_test(options: argparse.Namespace) -> int:
    return self_test(options.course, options.underlay, max(1, options.jobs))


def _show_variant(options: argparse.Namespace) -> int:
    name, course = options.show_variant, options.course
    print(sheet(course, variant_of(course, name, options.variant, options.variants), name))
    return 0


def _solution(options: argparse.Namespace) -> int:
    memory = Memory(options.workspace, options.course, NEVER)
    show_solution(options.course, options.exercises, memory)
    return 0


# {command: the function that runs it and returns the exit code}
COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    CHECK: check,
    "all": check_all,
    "package": _package,
    "self-test": _self_test,
    "show-variant": _show_variant,
    "solution": _solution,
    "watch": watch,
}


def main() -> None:
    """Run the command. Exit code 0: nothing is wrong; 1: mistakes; 2: the checker cannot work."""
    assert isinstance(sys.stdout, io.TextIOWrapper)
    sys.stdout.reconfigure(errors="backslashreplace")  # for file names that are not UTF-8
    options = parse(sys.argv[1:])
    for number in (signal.SIGTERM, signal.SIGHUP):  # as Ctrl-C, which also ends what was started
        if signal.getsignal(number) != signal.SIG_IGN:  # set by nohup
            signal.signal(number, signal.default_int_handler)
    for line in bubblewrap.lacking():
        print(f"check: {line}", file=sys.stderr, flush=True)
    try:
        code = COMMANDS[options.command](options)
    except CannotCheck as error:
        print(f"\ncheck: no verdict: {fault(error)}", file=sys.stderr)
        code = 2
    except BrokenPipeError:  # The reader has ended, as head does.
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  for what is unwritten
        code = 2
    except Exception as error:  # not the student's fault, whatever it is
        print(f"\ncheck: {fault(error)}", file=sys.stderr)
        print("check: this is a fault of the check, not of your exercises", file=sys.stderr)
        code = 2
    except KeyboardInterrupt:
        if options.command != "watch":
            print("\ncheck: interrupted: no verdict", file=sys.stderr)
        code = 130
    sys.exit(code)
