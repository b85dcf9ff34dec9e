"""From what a program printed to its traceback. Pure."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Traceback:
    """The end of a Python traceback."""

    error: str  # "NameError: name 'pub' is not defined"
    where: str = ""  # "scripts/joy2twist.py:14", the student's own line
    text: str = ""  # the source line
    places: tuple[str, ...] = ()  # all calls to it, the outermost first

    @property
    def message(self) -> str:
        """What str() of the exception gives."""
        return re.sub(r"^[\w.]+: |\. Did you mean: .*", "", self.error)

    def lines_of(self, script: str) -> list[int]:
        parts = (place.rpartition(":") for place in self.places)
        return [int(line) for file, _, line in parts if file == script]


FRAME = re.compile(r'^\s*File "(?P<file>[^"]+)", line (?P<line>\d+)')
ERROR = re.compile(r"^(?:[A-Za-z_][\w.]*(?:[Ee]rror|Exception|NotFound|Interrupt|Exit)\b.*)$")
# Said of a node that is being ended: rospy closes topics shortly before it says so. No mistake.
CLOSED = re.compile(r"publish\(\) to a closed topic|topic was closed during publish\(\)")
# As rospy prints what came up in a service: a list of lines, as Python writes it.
OF_SERVICE, LINE_END = "['Traceback", re.compile(r"\\n(?:['\"](?:, ['\"]|\]))?")
ABOVE = "During handling of the above exception"


def first_traceback(output: str, folder: str) -> Traceback | None:
    """Return the first Traceback in the output, or None; files of the folder are the student's."""
    if OF_SERVICE in output:
        output = LINE_END.sub("\n", output)
    traces: list[Traceback] = []
    is_closed = False
    for block in reversed(output.split("Traceback (most recent call last)")[1:51]):
        if block.strip(": \n"):  # else it was cut off behind this line
            trace = _traceback(block, folder)
            # What led to such an end, which rospy reports before it, is none, either.
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
    """Return the end of an output, in one line, without colours."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", output)
    # Of what rospy says of types that differ, the md5sum is most.
    lines = [line.strip() for line in plain.splitlines() if line.strip() and "md5sum" not in line]
    return " / ".join(line[:200] for line in lines[-count:])
