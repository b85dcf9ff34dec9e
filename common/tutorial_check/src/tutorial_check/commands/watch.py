"""--watch: check a workspace again whenever a file in it is saved."""

from __future__ import annotations

import argparse
import contextlib
import os
import stat
import sys
import time
from typing import NoReturn

from tutorial_check.commands.check import examine_and_print
from tutorial_check.errors import CannotCheck, fault
from tutorial_check.report.text import summary
from tutorial_check.submission.handed_in import all_below

PERIOD_S = 0.5  # between two looks, which must agree, because editors save in several steps
OF_EDITORS = ("~", ".swp")


def stamps(folder: str) -> dict[str, tuple[int, int]]:
    """Return {path: (time of the last change, also of permissions; size)} of a student's files."""
    times = {}
    for path in all_below(folder):
        with contextlib.suppress(OSError):  # removed in the meantime
            about = os.stat(path)
            if not (stat.S_ISDIR(about.st_mode) or path.endswith(OF_EDITORS)):
                times[path] = about.st_ctime_ns, about.st_size
    return times


def watch(options: argparse.Namespace) -> NoReturn:
    """Until Ctrl-C: check, report the first mistake, wait for a change. Raises CannotCheck."""
    if not os.path.isdir(options.workspace):
        raise CannotCheck(f"{options.workspace}: no folder, and --watch is for one")
    while True:
        before = stamps(options.workspace)
        print("\x1b[2J\x1b[H" if sys.stdout.isatty() else "", end="")
        try:
            outcomes = examine_and_print(options, only_first=True)
        except CannotCheck as error:
            print(f"check: {fault(error)}")  # half saved, or the folder is being moved
        else:
            solved = ", ".join(outcome.id for outcome in outcomes if outcome.solved)
            all_passed = all(outcome.passed for outcome in outcomes)
            print(summary(outcomes) if all_passed else f"done: {solved or 'none yet'}")
        print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
        last = now = before
        while now == before or now != last:  # until nothing changes for a moment
            time.sleep(PERIOD_S)
            last, now = now, stamps(options.workspace)
