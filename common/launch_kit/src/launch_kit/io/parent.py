"""The roslaunch that started this program: its command line, its log."""

from __future__ import annotations

import os
import re
from pathlib import Path

FOLDER = Path(f"/proc/{os.getppid()}")
LOG = re.compile(rf".*/roslaunch-.*-{os.getppid()}\.log")


def command_line() -> list[str]:
    """Return its words: the commands of a launch file get no others."""
    return (FOLDER / "cmdline").read_bytes().decode(errors="replace").rstrip("\0").split("\0")


def is_first(note: str) -> bool:
    """Return whether a note is new in roslaunch's log, and write it there.

    This is how the commands of several launch files know of each other. Without a log it is new.
    """
    started = (FOLDER / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()[19]
    line = f"{note} (roslaunch {os.getppid()}, started at {started})\n"  # numbers are used again
    try:
        targets = map(os.readlink, (FOLDER / "fd").iterdir())
        log = Path(next(filter(LOG.fullmatch, targets)))
        if line in log.read_text(encoding="utf-8", errors="replace"):
            return False
        with log.open("a", encoding="utf-8") as file:
            file.write(line)
    except (OSError, StopIteration):
        pass
    return True
