"""Why a program in C++ has failed: its line and the fix, by what it printed and its text."""

from __future__ import annotations

import re
from typing import Callable

from tutorial_check.checking.causes import explained
from tutorial_check.checking.cpp_causes import cause_of_abort
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.data.recordings import Ran
from tutorial_check.submission.aborts import (
    TRACEBACK,
    abort_of,
    has_failed,
    place_of_abort,
    signal_of,
)
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_check.submission.cpp_lapses import ABOVE

UNCAUGHT = "nothing catches this exception: the program ends where it is thrown"
NAME = re.compile(r"[Nn]ame \[(?P<name>.*?)\](?:\.  Valid|:)")
# {pattern for an error: the line to blame, or 0}; the first that matches counts.
LINES: dict[str, Callable[[CppFacts], int]] = {
    "name must not be empty": lambda facts: _first(facts, "init_node"),
    "out of dual 32-bit": lambda facts: _first(facts, "Rate", "Duration"),
    "out_of_range": lambda facts: _first(facts, "at", "substr"),
}


def compiled_program(submission: Submission, package: str, name: str) -> str:
    """Return the path of the program in C++ whose executable has a name; or ""."""
    for path in submission.cpp_programs(package) if submission.cpp_sources(package) else ():
        executable = submission.executable_of(package, path)
        if executable and executable.name == name:
            return path
    return ""


def compiled_crash(submission: Submission, package: str, ran: Ran, expected: str) -> Wrong | None:
    """Return the Wrong for a program in C++ that has failed; None if it has not, or is none."""
    may_be = has_failed(ran) and TRACEBACK not in ran.output
    path = compiled_program(submission, package, ran.name) if may_be else ""
    if not path:
        return None
    facts, signal = submission.cpp_programs(package)[path], signal_of(ran)
    error = abort_of(ran.output)
    seen = error or f"the program was ended by {signal}"
    line, hint = blamed(error or signal, facts)
    line = facts.line_in(*place_of_abort(ran.output)) or line
    hint = hint or (UNCAUGHT if "::" in error else "")
    return Wrong(expected, seen, facts.place(path, line), hint, sure=bool(error))


def blamed(error: str, facts: CppFacts) -> tuple[int, str]:
    """Return (line or 0, fix) for an error of a program."""
    line, hint = cause_of_abort(error, facts)
    if line:
        return line, hint or "".join(explained("c++", error))
    line = next((find(facts) for pattern, find in LINES.items() if re.search(pattern, error)), 0)
    name = NAME.search(error)
    text = name["name"] if name else error.partition(": ")[2]
    line = line or (facts.line_of_text(text) if text else 0)
    if "ros::init() before" in error:
        return facts.lapses.early_handle or (_first(facts, "NodeHandle"), ABOVE)
    return line, "".join(explained("c++", error))


def _first(facts: CppFacts, *names: str) -> int:
    return next(iter(facts.lines(*names)), 0)
