"""A lock on the workspace: only one ./tutorial builds at a time."""

from __future__ import annotations

import contextlib
import fcntl
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from tutorial_tools.io.system.apt import say

PATIENCE_S = 2.0  # A shorter wait is not reported.
WAITS = "another ./tutorial is building here; this one waits for it"


@contextlib.contextmanager
def one_at_a_time(workspace: Path) -> Iterator[None]:
    """Hold the workspace's lock, after waiting for another call."""
    workspace.mkdir(parents=True, exist_ok=True)
    with open(workspace / "lock", "w", encoding="utf-8") as file:
        end_s = time.monotonic() + PATIENCE_S
        while not _is_locked_by(file):
            if time.monotonic() > end_s:
                say(WAITS)
                fcntl.flock(file, fcntl.LOCK_EX)
                break
            time.sleep(0.05)
        yield


def _is_locked_by(file: TextIO) -> bool:
    """Try to lock a file without waiting; return whether it is locked."""
    with contextlib.suppress(BlockingIOError):
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    return False
