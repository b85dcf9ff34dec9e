"""Starting programs as a user does in a terminal, and ending them as Ctrl-C does."""

import os
import signal
import subprocess
import tempfile
from pathlib import Path

from waiting import DEADLINE_S, wait_for


class Program:
    """A program in a session of its own; its output, both streams together, is kept.

    Use it as a context manager, so that nothing is left running whatever the test comes to.
    """

    def __init__(self, *command, **environment):
        self._output = tempfile.TemporaryFile("w+")  # noqa: SIM115  closed in __exit__
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=self._output,
            stderr=subprocess.STDOUT,
            # Unbuffered: a test waits for what roslaunch, a Python program itself, prints.
            env={**os.environ, "PYTHONUNBUFFERED": "1", **environment},
            start_new_session=True,  # like a terminal's: children can be found by it
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for pid in self.left_behind():
            os.kill(pid, signal.SIGKILL)
        self._process.wait()
        self._output.close()

    @property
    def output(self):
        """All that was printed so far."""
        # Not by read(): the program writes at the position that the two share.
        descriptor = self._output.fileno()
        return os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode(errors="replace")

    @property
    def ended(self):
        """Whether the program itself has ended."""
        return self._process.poll() is not None

    def interrupt(self):
        """Press Ctrl-C: SIGINT to the group in the foreground."""
        os.killpg(self._process.pid, signal.SIGINT)

    def wait(self, deadline_s=DEADLINE_S):
        """Wait for the end; return the exit code."""
        wait_for(lambda: self.ended, f"end of {self._process.args[:3]}", deadline_s)
        return self._process.returncode

    def left_behind(self):
        """The ids of all processes of this session that still run."""
        pids = []
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                state, _, _, session = stat.read_text().rsplit(")", 1)[1].split()[:4]
            except OSError:
                continue  # ended meanwhile
            if int(session) == self._process.pid and state != "Z":
                pids.append(int(stat.parent.name))
        return pids
