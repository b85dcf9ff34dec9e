"""Finds the errors in the output of catkin_make."""

from __future__ import annotations

import re
from collections.abc import Sequence

WRONG = re.compile("rror|invalid|mismatched|not found")
PROGRESS = ("-- ", "####")  # Lines that are never errors.
MOST = 8  # lines; a message of CMake ends with what to do


def first_errors(lines: Sequence[str]) -> list[str]:
    """Return the first errors with the lines indented below them; or the last line."""
    errors, inside = [], False
    for line in lines:
        starts = WRONG.search(line) is not None and not line.startswith(PROGRESS)
        inside = starts or (inside and line[:1] in ("", " "))
        if inside and line.strip():
            errors.append(line)
    return errors[:MOST] or list(lines[-1:])
