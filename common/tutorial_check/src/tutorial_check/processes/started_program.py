"""A started program: its output, and how it ended."""

from __future__ import annotations

import contextlib
import os
import subprocess

from tutorial_check.data.recordings import Ran
from tutorial_check.processes.cpu_clock import Times, fields_of, is_ready, times_of

SPINNING_S = 6.0  # [s of CPU time] a ROS program needs less than 1 s to start
KEPT_FIRST, KEPT_LAST = 200_000, 50_000  # bytes of a program's output


class Program:
    """A student's program, or one that serves the check."""

    def __init__(self, process: subprocess.Popen[bytes], name: str) -> None:
        assert process.stdout
        self.process, self.name, self.pipe = process, name, process.stdout
        self.was_stopped = False  # by us: then its exit code means nothing
        self._worked_s = 0.0
        self._times: Times = {}  # per thread, at the last rests()
        self._first, self._last, self._printed = bytearray(), bytearray(), 0

    @property
    def ended(self) -> bool:
        return self.has_ended()

    def has_ended(self) -> bool:
        """Return whether it has ended; a condition for Runner.wait()."""
        return self.process.poll() is not None

    def signal(self, number: int) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, number)

    def stop(self, number: int) -> None:
        """Signal it to end, and note its CPU time, which the kernel later forgets."""
        with contextlib.suppress(OSError):
            fields = fields_of(f"/proc/{self.process.pid}/stat")
            self._worked_s = sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")
        if not self.ended:
            self.was_stopped = True
            self.signal(number)

    def rests(self) -> bool:
        """Return whether no thread of it has run since the last call, or is ready to."""
        pid = self.process.pid
        before, self._times = self._times, times_of(pid)
        return before == self._times and not any(is_ready(pid, thread) for thread in before)

    @property
    def ran(self) -> Ran:
        """What a recording keeps of it."""
        code = self.process.poll() if not self.was_stopped else None
        spins = self.was_stopped and self._worked_s > SPINNING_S
        return Ran(self.name, self.output, code, spins, self.was_stopped)

    @property
    def output(self) -> str:
        """What it printed, without the middle of a very long output."""
        gap = b"\n[...]\n" if self._printed > KEPT_FIRST + KEPT_LAST else b""
        return (self._first + gap + self._last).decode(errors="replace")

    def read(self) -> bool:
        """Read its new output; return False at the end of the output."""
        data = self.pipe.read(65536)
        if data is None:  # nothing yet
            return True
        self._printed += len(data)
        free = KEPT_FIRST - len(self._first)
        self._first += data[:free]
        self._last = (self._last + data[free:])[-KEPT_LAST:]
        return bool(data)
