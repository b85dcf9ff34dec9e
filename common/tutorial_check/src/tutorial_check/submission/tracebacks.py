"""The traceback in a program's output."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Traceback:
    """The end of a Python traceback."""

    error: str  # "NameError: name 'pub' is not defined"
    where: str = ""  # "scripts/joy2twist.py:14", the student's own line
    text: str = ""  # the source line
    places: tuple[str, ...] = ()  # of all calls in the student's files, the outermost first

    @property
    def message(self) -> str:
        """str() of the exception."""
        return re.sub(r"^[\w.]+: |\. Did you mean: .*", "", self.error)

    def lines_of(self, script: str) -> list[int]:
        parts = (place.rpartition(":") for place in self.places)
        return [int(line) for file, _, line in parts if file == script]


FRAME = re.compile(r'^\s*File "(?P<file>[^"]+)", line (?P<line>\d+)')
ERROR = re.compile(r"^(?:[A-Za-z_][\w.]*(?:[Ee]rror|Exception|NotFound|Interrupt|Exit)\b.*)$")
# No mistake: printed by a node that is ending, because rospy closes topics shortly before.
CLOSED = re.compile(r"publish\(\) to a closed topic|topic was closed during publish\(\)")
# rospy prints an exception in a service as Python's representation of a list of lines.
OF_SERVICE, LINE_END = "['Traceback", re.compile(r"\\n(?:['\"](?:, ['\"]|\]))?")
ABOVE = "During handling of the above exception"


def first_traceback(output: str, folder: str) -> Traceback | None:
    """Return the first Traceback in the output, or None. folder: of the student's files."""
    if OF_SERVICE in output:
        output = LINE_END.sub("\n", output)
    traces: list[Traceback] = []
    is_closed = False
    for block in reversed(output.split("Traceback (most recent call last)")[1:51]):
        if block.strip(": \n"):  # else the output was cut here
            trace = _traceback(block, folder)
            # Nor is what rospy reports before it, as the cause of such an end, a mistake.
            is_closed = bool(CLOSED.search(trace.error)) or (is_closed and ABOVE in block)
            traces += [] if is_closed else [trace]
    return next((trace for trace in traces[::-1] if trace.where), traces[-1] if traces else None)


def _traceback(block: str, folder: str) -> Traceback:
    lines = [*block.splitlines(), ""]
    error, text, places = lines[-2], "", [""]
    for line, below in zip(lines[1:], lines[2:]):
        frame = FRAME.match(line)
        if frame and frame["file"].startswith(folder):
            places.append(f"{frame['file'][len(folder) :].lstrip('/')}:{frame['line']}")
            text = below.strip()
        elif ERROR.match(line):
            error = line
            break
    return Traceback(error.strip(), places[-1], text, tuple(places))


def last_lines(output: str, count: int = 3) -> str:
    """Return the last lines of an output, joined into one, without colours."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", output)
    # rospy's md5sums of types that differ are long and useless.
    lines = [line.strip() for line in plain.splitlines() if line.strip() and "md5sum" not in line]
    return " / ".join(line[:200] for line in lines[-count:])
