"""Whether a program has failed, and the error that C++ and its libraries print at such an end."""

from __future__ import annotations

import re
import signal

from tutorial_check.data.recordings import Ran

# What ends a program that does something forbidden: {number: words}.
SIGNALS: dict[int, str] = {
    signal.SIGILL: "an instruction that does not exist",
    signal.SIGTRAP: "a breakpoint",
    signal.SIGABRT: "abort()",
    signal.SIGBUS: "no such memory",
    signal.SIGFPE: "a whole number divided by 0",
    signal.SIGSEGV: "a segmentation fault",
}
TRACEBACK = "Traceback (most recent call last)"
EXCEPTION = re.compile(
    r"^terminate called (?:after throwing an instance of '(?P<kind>.+)'"
    r"(?:\s+what\(\): *(?P<what>.*))?|without an active exception)",
    re.MULTILINE,
)
# Of a line. Bounded, as what follows: a hostile program may print long lines without end.
ASSERTION = re.compile(
    r"(?P<file>[^:\s]{1,200}):(?P<line>\d{1,7}): .*(?P<what>Assertion .* failed)\."
)
MOST_LINES, MOST_OF_A_LINE = 20, 2000
OF_GLIBC = re.compile(
    r"^(?:(?:free|malloc|realloc|munmap_chunk)\(\)|double free|corrupted|\*\*\* stack).*",
    re.MULTILINE,
)
FATAL = re.compile(r"\[FATAL\] \[[^\]\n]{0,99}\]: *(?P<what>[^\n\x1b]*)")
OF_ROS = re.compile(
    r"ASSERTION FAILED\s+file = (?P<file>\S+)\s+line = (?P<line>\d+)\s+cond = (?P<cond>.*)"
)
NO_CAUSE = ("ASSERTION FAILED", "BREAKPOINT HIT", "")  # roscpp's words around the cause


def abort_of(output: str) -> str:
    """Return the error with which a program in C++ has ended, as it was printed; or ""."""
    exception = EXCEPTION.search(output)
    if exception:
        words = (_plain(exception["kind"] or ""), exception["what"] or "")
        return ": ".join(filter(None, words)) or exception[0]
    fatal = FATAL.findall(output)
    if any(line in fatal for line in NO_CAUSE[:2]):
        asserted = OF_ROS.search(output)
        cause = f"assertion {asserted['cond'].strip()} failed" if asserted else NO_CAUSE[0]
        return next((line for line in reversed(fatal) if line not in NO_CAUSE), cause)
    assertion, other = _assertion(output), OF_GLIBC.search(output)
    return assertion["what"] if assertion else other[0] if other else ""


def place_of_abort(output: str) -> tuple[str, int]:
    """Return (file, line) that the message of a failed assertion names, or ("", 0)."""
    place = _assertion(output) or OF_ROS.search(output)
    return (place["file"], int(place["line"])) if place else ("", 0)


def _assertion(output: str) -> re.Match[str] | None:
    """Return the first assertion of the C or C++ library that has failed, or None."""
    lines = [line for line in output.splitlines() if "Assertion " in line]
    short = [line for line in lines[:MOST_LINES] if len(line) < MOST_OF_A_LINE]
    return next(filter(None, map(ASSERTION.search, short)), None)


def _plain(kind: str) -> str:
    """Return an exception's class without those of Boost around it."""
    return kind.rstrip("> ").rpartition("<")[2]


def has_error(output: str) -> bool:
    """Return whether an output has the error of a program that failed, in any language."""
    return TRACEBACK in output or bool(abort_of(output))


def has_failed(program: Ran) -> bool:
    """Return whether a program printed such an error, or did what ends it at once."""
    return has_error(program.output) or signal_of(program) != ""


def signal_of(program: Ran) -> str:
    """Return the name and the meaning of the signal that has ended a failed program, or ""."""
    number = -(program.code or 0)
    return f"{signal.Signals(number).name}, {SIGNALS[number]}" if number in SIGNALS else ""
