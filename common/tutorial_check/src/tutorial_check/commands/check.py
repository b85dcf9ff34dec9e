"""Check one workspace once; write the results to the terminal, and to files for programs."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from tutorial_check.checking.results import Outcome
from tutorial_check.course.tasks import variant_of
from tutorial_check.errors import CannotCheck
from tutorial_check.examining.examination import examine
from tutorial_check.report.formats import FORMATS, clear, keep, without_hints, write
from tutorial_check.report.memory import NEVER, Memory
from tutorial_check.report.text import Terminal, summary
from tutorial_check.submission.order import Order


def check(options: argparse.Namespace) -> int:
    """Check a workspace; return the exit code. Raises CannotCheck."""
    given = {name: getattr(options, name) for name in FORMATS}
    files = {name: file for name, file in given.items() if file}
    for file in files.values():
        clear(file)
    is_callers_own = not {"gradescope", "classroom"} & files.keys()
    outcomes = examine_and_print(options, is_callers_own=is_callers_own)
    folder = os.path.abspath(options.workspace)
    print(f"{summary(outcomes)} in {folder}")
    handed_out = without_hints(outcomes) if options.hints == NEVER else outcomes
    if options.keep:
        keep(options.keep, os.path.basename(folder), handed_out)
    _write_files(files, handed_out)
    if any(outcome.trouble for outcome in outcomes):
        return 2
    return int(not all(outcome.passed for outcome in outcomes))


def examine_and_print(
    options: argparse.Namespace, *, only_first: bool = False, is_callers_own: bool = True
) -> list[Outcome]:
    """Examine; print and remember the results. only_first: stop at the first wrong one."""
    memory = Memory(options.workspace, options.course, options.hints)
    terminal = Terminal(memory.hint_of, only_first)
    terminal.busy("copying and preparing ...")
    workspace = Path(options.workspace)
    try:
        order = Order(
            workspace, options.underlay, options.exercises, only_first, is_callers_own,
            course=options.course.folder, variant=variant_of(options.course, "", options.variant),
            language=options.language,
        )  # fmt: skip
        outcomes = examine(order, terminal.result, side_by_side=is_callers_own)
    finally:
        terminal.busy("")
    for outcome in outcomes:
        if outcome.trouble:
            print(f"check: {outcome.id}: no verdict: {outcome.trouble}", file=sys.stderr)
    memory.keep(outcomes)
    return outcomes


def _write_files(files: dict[str, str], outcomes: list[Outcome]) -> None:
    """Write every file, even if another one cannot be written. Raises CannotCheck."""
    faults = []
    for name, file in files.items():
        try:
            if name == "classroom" and any(outcome.trouble for outcome in outcomes):
                # Its format has no such verdict. Without a file it reports an error, and no points.
                why = "not every exercise has a verdict"
                print(f"check: {file} is not written: {why}", file=sys.stderr)
            else:
                write(file, FORMATS[name][1](outcomes))
        except CannotCheck as error:
            faults.append(str(error))
    if faults:
        raise CannotCheck("; ".join(faults))
