"""Of two ./tutorial at once one builds, and the other one waits and finds it done."""

from __future__ import annotations

import contextlib
import fcntl
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from tutorial_tools.io.system.apt import say

PATIENCE_S = 2.0  # A wait for another call that is shorter is not worth a line.
WAITS = "another ./tutorial is building here; this one waits for it"


@contextlib.contextmanager
def one_at_a_time(workspace: Path) -> Iterator[None]:
    """Of two calls at once let one do the work, and the other wait and find it done."""
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
    """Lock a file; return whether that was possible without waiting."""
    with contextlib.suppress(BlockingIOError):
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    return False
