"""A program that runs, and what it printed."""

from __future__ import annotations

import contextlib
import os
import subprocess
import time

KEPT_FIRST, KEPT_LAST = 200_000, 50_000  # bytes of a program's output
SPINNING_S = 6.0  # of a processor's time; to start, a ROS program needs less than one


def fields_of(stat: str) -> list[bytes]:
    """Return a /proc/*/stat from its third field on; the second is a name, of any bytes. Raises OSError."""
    with open(stat, "rb") as file:
        return file.read().rsplit(b")", 1)[1].split()


class Forked:
    """What subprocess.Popen is to a program, to a copy of this process."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self.returncode: int | None = None

    def poll(self) -> int | None:
        """Return its exit code, or None while it runs."""
        return self.wait(os.WNOHANG)

    def wait(self, options: int = 0) -> int | None:
        """Return its exit code, as subprocess has it, once it has ended."""
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, options)
            if pid and os.WIFSIGNALED(status):
                self.returncode = -os.WTERMSIG(status)
            elif pid:
                self.returncode = os.WEXITSTATUS(status)
        return self.returncode


class Program:
    """A program of the student's, or one that serves the check."""

    def __init__(self, process: subprocess.Popen[bytes] | Forked, name: str, descriptor: int):
        """descriptor: on which its output is read."""
        self.process, self.name, self.descriptor = process, name, descriptor
        self.began_s = time.monotonic()
        self.was_stopped = False  # by us: then how it ended says nothing
        self._worked_s = 0.0
        self._first, self._last, self.printed = bytearray(), bytearray(), 0

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        return self.process.poll() is not None

    def note_work(self) -> None:
        """Note how long it has worked, before it is ended: later the kernel does not know."""
        with contextlib.suppress(OSError):
            fields = fields_of(f"/proc/{self.process.pid}/stat")
            self._worked_s = sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")

    @property
    def spins(self) -> bool:
        """Whether it worked without end until we ended it, so that no busy machine is to blame."""
        return self.was_stopped and self._worked_s > SPINNING_S

    @property
    def output(self) -> str:
        """What it printed; the middle of very much is left out."""
        gap = b"\n[...]\n" if self.printed > KEPT_FIRST + KEPT_LAST else b""
        return (self._first + gap + self._last).decode(errors="replace")

    def read(self) -> bool:
        """Take what it printed since the last time; return False at the end of its output."""
        try:
            data = os.read(self.descriptor, 65536)
        except BlockingIOError:
            return True
        self.printed += len(data)
        free = KEPT_FIRST - len(self._first)
        self._first += data[:free]
        self._last = (self._last + data[free:])[-KEPT_LAST:]
        return bool(data)
