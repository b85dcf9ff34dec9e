"""--watch: checks again when a file is saved, up to the first thing wrong."""

from __future__ import annotations

import argparse
import contextlib
import os
import stat
import sys
import time
from dataclasses import replace
from typing import NoReturn

from tutorial_check.examination import examine
from tutorial_check.hints import Memory
from tutorial_check.model import CannotCheck
from tutorial_check.report import Terminal, lines_of, summary
from tutorial_check.variants import variant_of
from tutorial_check.workspace import all_below

PERIOD_S = 0.5  # between two looks; editors save in several steps, so two must be the same
OF_EDITORS = ("~", ".swp")


def stamps(folder: str) -> dict[str, tuple[int, int]]:
    """Return {path: (time of the last change, also of its rights; size)} of the student's files in a folder."""
    found = {}
    for path in all_below(folder):
        with contextlib.suppress(OSError):  # removed meanwhile
            about = os.stat(path)
            if not (stat.S_ISDIR(about.st_mode) or path.endswith(OF_EDITORS)):
                found[path] = about.st_ctime_ns, about.st_size
    return found


def wait_for_change(folder: str, before: dict[str, tuple[int, int]]) -> None:
    """Return once something differs from before, and then nothing changes for a moment."""
    last, now = before, before
    while now == before or now != last:
        time.sleep(PERIOD_S)
        last, now = now, stamps(folder)


def watch(options: argparse.Namespace) -> NoReturn:
    """Until Ctrl-C: examine, report the first that is wrong, wait for a change. Raises CannotCheck."""
    if not os.path.isdir(options.workspace):
        raise CannotCheck(f"{options.workspace}: no folder, and --watch is for one")
    while True:
        before = stamps(options.workspace)
        print("\x1b[2J\x1b[H" if sys.stdout.isatty() else "", end="")
        report_once(options)
        print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
        wait_for_change(options.workspace, before)


def report_once(options: argparse.Namespace) -> None:
    memory = Memory(options.workspace, options.course, options.hints)
    terminal = Terminal(memory.hint_of)
    terminal.busy("copying and preparing ...")
    try:
        outcomes = examine(
            options.workspace,
            options.underlay,
            options.exercises,
            lambda outcome, _: terminal.busy(f"checking {outcome.id} ..."),
            only_first=True,
            course=options.course.folder,
            variant=variant_of(options.course, options, ""),
        )
    except CannotCheck as error:
        terminal.busy("")
        print(f"check: {error}")  # half-saved, or a folder that is just being moved
        return
    terminal.busy("")
    for outcome in outcomes:
        for wrong in outcome.wrong[:1]:
            print("\n".join(lines_of(replace(wrong, hint=memory.hint_of(wrong)))))
        if outcome.trouble:
            print(f"check: {outcome.id}: no verdict: {outcome.trouble}")
    memory.keep(outcomes)
    solved = ", ".join(one.id for one in outcomes if one.solved)
    all_passed = all(outcome.passed for outcome in outcomes)
    print(summary(outcomes) if all_passed else f"done: {solved or 'none yet'}")
