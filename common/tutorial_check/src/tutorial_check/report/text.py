"""The report in the terminal."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from typing import Callable, Sequence

from tutorial_check.checking.results import NOTE, OK, UNREACHED, WRONG, Outcome, Result

WORDS = {OK: "ok", WRONG: "WRONG", NOTE: "note", UNREACHED: "-"}
COLOURS = {OK: "32", WRONG: "1;31", NOTE: "33", UNREACHED: "2"}
MARGIN = " " * 11


def lines_of(result: Result) -> list[str]:
    head = f"  {WORDS[result.status]:<6} {result.id:<4}{result.title}"
    if result.status == OK:
        return [head + (f"  ({result.seen})" if result.seen else "")]
    if result.status == UNREACHED:
        return [f"{head}: not reached; {result.seen}"]
    words = ((name, getattr(result, name)) for name in ("expected", "seen", "where", "hint"))
    lines = [head, *(f"{MARGIN}{name + ':':<9} {text}" for name, text in words if text)]
    if result.status == WRONG:
        see = f"; see it yourself: {result.look}" if result.look else ""
        lines.append(f"{MARGIN}{result.section}{see}")
    return lines


def heading(outcome: Outcome) -> str:
    return f"{outcome.id} {outcome.title}".rstrip()


def summary(outcomes: Sequence[Outcome]) -> str:
    empty = ", ".join(outcome.id for outcome in outcomes if outcome.empty)
    first = next(iter(outcomes), Outcome(""))
    place = f"workspace: {first.place}" if first.place else ""
    remarks = (f"{empty}: nothing to check" if empty else "", place, first.remark)
    rest = "".join(f" ({remark})" for remark in remarks if remark)
    return f"{sum(outcome.solved for outcome in outcomes)} of {len(outcomes)} exercises done{rest}"


def text_of(outcomes: Sequence[Outcome]) -> str:
    """Return the complete report without colours."""
    lines = []
    for outcome in outcomes:
        lines.append(heading(outcome))
        lines += (line for result in outcome.results for line in lines_of(result))
    return "\n".join([*lines, summary(outcomes)]) + "\n"


class Terminal:
    """Prints results as they come, and in a terminal a line on the current activity."""

    def __init__(self, hint_of: Callable[[Result], str], only_first: bool = False) -> None:
        """hint_of: returns the hint to show for a Result. only_first: show one mistake only."""
        self._hint_of, self._only_first, self._heading = hint_of, only_first, ""
        self._is_terminal = sys.stdout.isatty()
        self._has_colour = self._is_terminal and "NO_COLOR" not in os.environ

    def busy(self, words: str) -> None:
        """Show a line that the next one replaces; if words is empty, remove it."""
        if self._is_terminal:
            print(f"\r\x1b[K{words}", end="", flush=True)

    def result(self, outcome: Outcome, result: Result) -> None:
        self.busy("")
        if self._only_first and (self._heading or result.status != WRONG):
            self.busy(f"  checking {outcome.id} ...")
            return
        if self._heading != outcome.id:
            self._heading = outcome.id
            print(heading(outcome))
        first, *rest = lines_of(replace(result, hint=self._hint_of(result)))
        if self._has_colour:
            first = f"\x1b[{COLOURS[result.status]}m{first}\x1b[0m"
        print("\n".join([first, *rest]), flush=True)
        self.busy(f"  checking {outcome.id} ...")
