"""One workspace: checked once, or (--watch) again when a file is saved, up to the first thing wrong."""

from __future__ import annotations

import argparse
import contextlib
import os
import stat
import sys
import time
from pathlib import Path
from typing import NoReturn

from tutorial_check.launcher import examine
from tutorial_check.model import CannotCheck, Outcome
from tutorial_check.order import Order
from tutorial_check.report.formats import FORMATS, clear, keep, without_hints, write
from tutorial_check.report.memory import Memory, show_solution
from tutorial_check.report.text import Terminal, summary
from tutorial_check.source.workspace import all_below
from tutorial_check.variants import variant_of

PERIOD_S = 0.5  # between two looks; editors save in several steps, so two must be the same
OF_EDITORS = ("~", ".swp")


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
            own=not (options.gradescope or options.classroom),
            course=options.course.folder, variant=variant_of(options.course, options, ""),
        )  # fmt: skip
        outcomes = examine(order, terminal.result)
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
    """Return {path: (time of the last change, also of its rights; size)} of the student's files in a folder."""
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
            print(f"check: {error}")  # half-saved, or a folder that is just being moved
        else:
            solved = ", ".join(one.id for one in outcomes if one.solved)
            all_passed = all(outcome.passed for outcome in outcomes)
            print(summary(outcomes) if all_passed else f"done: {solved or 'none yet'}")
        print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
        last = now = before
        while now == before or now != last:  # and then nothing changes for a moment
            time.sleep(PERIOD_S)
            last, now = now, stamps(options.workspace)
