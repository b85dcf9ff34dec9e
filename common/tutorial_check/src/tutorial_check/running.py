"""A program that runs, and what it printed."""

import contextlib
import os
import time

KEPT_FIRST, KEPT_LAST = 200_000, 50_000  # bytes of a program's output
SPINNING_S = 6.0  # of a processor's time; to start, a ROS program needs less than one


def fields_of(stat):
    """A /proc/*/stat from its third field on; the second is a name, of any bytes. Raises OSError."""
    with open(stat, "rb") as file:
        return file.read().rsplit(b")", 1)[1].split()


class Program:
    """A program of the student's, or one that serves the check."""

    def __init__(self, process, name):
        self.process = process
        self.name = name
        self.began_s = time.monotonic()
        self.was_stopped = False  # by us: then how it ended says nothing
        self._worked_s = 0.0
        self._first, self._last, self.printed = bytearray(), bytearray(), 0

    @property
    def ended(self):
        """Whether it has ended."""
        return self.process.poll() is not None

    def note_work(self):
        """Look how long it has worked. To be called before it is ended: later nobody can tell."""
        with contextlib.suppress(OSError):
            fields = fields_of(f"/proc/{self.process.pid}/stat")
            self._worked_s = sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")

    @property
    def spins(self):
        """Whether it worked without end until we ended it, so that no busy machine is to blame."""
        return self.was_stopped and self._worked_s > SPINNING_S

    @property
    def output(self):
        """What it printed; the middle of very much is left out."""
        gap = b"\n[...]\n" if self.printed > KEPT_FIRST + KEPT_LAST else b""
        return (self._first + gap + self._last).decode(errors="replace")

    def read(self):
        """Take what it printed since the last time; False at the end of its output."""
        try:
            data = os.read(self.process.stdout.fileno(), 65536)
        except BlockingIOError:
            return True
        self.printed += len(data)
        room = KEPT_FIRST - len(self._first)
        self._first += data[:room]
        self._last = (self._last + data[room:])[-KEPT_LAST:]
        return bool(data)


class Forked:
    """What subprocess.Popen is to a program, to a copy of this process."""

    def __init__(self, pid):
        self.pid, self.returncode, self.stdout = pid, None, None

    def poll(self):
        """Its exit code, or None while it runs."""
        return self.wait(os.WNOHANG)

    def wait(self, options=0):
        """Its exit code, once it has ended."""
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, options)
            if pid:
                self.returncode = _exit_code(status)
        return self.returncode


def _exit_code(status):
    """As subprocess has it: minus the signal that ended it, if one did."""
    return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
