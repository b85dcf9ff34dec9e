"""What keeps the checker from working, and what ends a recording early."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

from node_kit.printable import quotable

MASTER_GONE, MULTIPLIES, CANNOT_START = "master gone", "multiplies", "cannot start"
UNREADABLE, NO_TYPE = "unreadable package.xml", "no such type"


@dataclass
class CutShort(Exception):
    """Nothing more can be recorded. kind: one of those above. seen: more about it."""

    kind: str
    seen: str = ""


class FileTooLarge(Exception):
    """A text file of the student's is larger than any that is written by hand; its name."""


class CannotCheck(Exception):
    """The checker cannot work, through no fault of the student's; the text says why in one line."""


def fault(error: Exception) -> str:
    """Return in one line why an exception keeps the checker from working; where, if it is a bug."""
    if isinstance(error, CannotCheck):
        return quotable(str(error))
    line = traceback.extract_tb(error.__traceback__)[-1]
    where = f"({Path(line.filename).name}:{line.lineno})"
    return quotable(f"{type(error).__name__}: {error} {where}")
