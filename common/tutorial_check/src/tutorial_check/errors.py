"""The checker's exceptions; only Wrong, a verdict, is beside the other verdicts in results."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

from node_kit.printable import quotable

MASTER_GONE, MULTIPLIES, CANNOT_START = "master gone", "multiplies", "cannot start"
UNREADABLE, NO_TYPE = "unreadable package.xml", "no such type"


class CheckerError(Exception):
    """Base class of the checker's errors; str() is one line for the user."""


class CannotCheck(CheckerError):
    """The checker cannot work, for a reason that is not the student's fault."""


class SchedulerGone(CannotCheck):
    """The scheduler has ended, and no other student can be checked."""


@dataclass
class CutShort(CheckerError):
    """A recording has ended early. kind: one of the constants above. seen: details."""

    kind: str
    seen: str = ""


class FileTooLarge(CheckerError):
    """A student's text file is larger than any written by hand; its name."""


class Ended(BaseException):
    """The worker has ended, so checking must stop: `except Exception` does not catch this."""


def fault(error: Exception) -> str:
    """Return one line on why an exception stops the checker; for a bug, also where."""
    if isinstance(error, CannotCheck):
        return quotable(str(error))
    line = traceback.extract_tb(error.__traceback__)[-1]
    where = f"({Path(line.filename).name}:{line.lineno})"
    return quotable(f"{type(error).__name__}: {error} {where}")
