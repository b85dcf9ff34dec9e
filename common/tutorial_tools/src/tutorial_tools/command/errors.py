"""What of catkin_make's output says what is wrong."""

from __future__ import annotations

import re
from collections.abc import Sequence

WRONG = re.compile("rror|invalid|mismatched|not found")
PROGRESS = ("-- ", "####")  # lines that name what is looked for, too
MOST = 8  # lines; the messages of CMake tell what to do in their last ones


def first_errors(lines: Sequence[str]) -> list[str]:
    """Return the first lines with an error, and the messages indented below; or the last line."""
    found, inside = [], False
    for line in lines:
        starts = WRONG.search(line) is not None and not line.startswith(PROGRESS)
        inside = starts or (inside and line[:1] in ("", " "))
        if inside and line.strip():
            found.append(line)
    return found[:MOST] or list(lines[-1:])
