"""--watch: checks again when a file is saved, the first wrong check on top."""

from __future__ import annotations

import argparse
import contextlib
import os
import time
from typing import Callable

from tutorial_check.examination import Outcome, examine
from tutorial_check.model import WRONG, CannotCheck
from tutorial_check.report import Terminal, lines_of, summary

PERIOD_S = 0.5  # between two looks; editors save in several steps, so two must be the same
IGNORED = {"build", "devel", ".git", "__pycache__"}


def stamps(folder: str) -> dict[str, tuple[int, int]]:
    """Return {path: (time of the last change, also of its rights; size)} of the student's files in a folder."""
    found = {}
    for here, folders, files in os.walk(folder):
        folders[:] = [each for each in folders if each not in IGNORED]
        for name in files:
            if not name.endswith(("~", ".swp")):
                path = os.path.join(here, name)
                with contextlib.suppress(OSError):  # removed meanwhile
                    about = os.stat(path)
                    found[path] = about.st_ctime_ns, about.st_size
    return found


def wait_for_change(folder: str, before: dict[str, tuple[int, int]]) -> None:
    """Return once something differs from before, and then nothing changes for a moment."""
    last = before
    while True:
        time.sleep(PERIOD_S)
        now = stamps(folder)
        if now == last and now != before:
            return
        last = now


def watch(options: argparse.Namespace, examine: Callable[..., list[Outcome]] = examine) -> int:
    """Until Ctrl-C: examine, report the first that is wrong, wait for a change. Raises CannotCheck."""
    if not os.path.isdir(options.workspace):
        raise CannotCheck(f"{options.workspace}: no folder, and --watch is for one")
    while True:
        before = stamps(options.workspace)
        print("\x1b[2J\x1b[H" if Terminal().is_terminal else "", end="")
        report_once(options, examine)
        print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
        wait_for_change(options.workspace, before)


def report_once(options: argparse.Namespace, examine: Callable[..., list[Outcome]]) -> None:
    """Check exercise after exercise, up to the first thing wrong."""
    outcomes: list[Outcome] = []
    terminal = Terminal()
    for exercise in options.exercises:
        terminal.busy(f"checking {exercise}")
        try:
            outcomes += examine(options.workspace, options.underlay, [exercise], only_first=True)
        except CannotCheck as error:
            terminal.done()
            print(f"check: {error}")  # half-saved, or a folder that is just being moved
            return
        terminal.done()
        wrong = [result for result in outcomes[-1].results if result.status == WRONG]
        if wrong:
            print("\n".join(lines_of(wrong[0], not options.no_hints)))
            break
        if outcomes[-1].trouble:
            print(f"check: {exercise}: no verdict: {outcomes[-1].trouble}")
            break
    if len(outcomes) == len(options.exercises) and outcomes[-1].passed:
        print(summary(outcomes))
    else:
        done = ", ".join(outcome.id for outcome in outcomes if outcome.passed and not outcome.empty)
        print(f"done: {done or 'none yet'}")
