"""A student who types a page's commands in the terminals of a new workspace."""

import contextlib
import functools
import os
import re
import shutil
import signal
import subprocess

from tutorial_testing.processes import signal_all
from tutorial_testing.waiting import descendants, wait_for

SHORT = "1"  # the terminal for commands that end; in the others they run until CTRL_C
CTRL_C, END = "Ctrl-C", "^done-1007"


def interrupt(shell):
    """Send SIGINT to the programs in the process group of a shell, but not to the shell (its id).

    Without job control the shell is in the same group, and SIGINT may discard its next input.
    """

    def running():
        with contextlib.suppress(ProcessLookupError):  # a process has ended
            return [pid for pid in descendants(shell)[1:] if os.getpgid(pid) == shell]

    signal_all(wait_for(running, "program to interrupt"), signal.SIGINT)


class Student:
    """A home, a workspace in it, and terminals: shells in which lines are typed."""

    def __init__(self, home, host, tutorial, suite_workspace):
        """home: a folder; tutorial: the command ./tutorial; suite_workspace: the built one."""
        self.workspace, self._terminals, self._begin = home / "ros/hydro/catkin_ws", {}, {}
        environment = {
            "HOME": str(home), "ROS_HOME": str(home / ".ros"), "DISPLAY": "",
            "ROS_MASTER_URI": "http://localhost:11311",
            "TUTORIAL_WORKSPACE": suite_workspace,  # not in this home
        }  # fmt: skip
        self._start = functools.partial(host.start, tutorial, **environment)

    def type(self, name, lines, seen):
        """Type lines in a terminal, opened if needed; wait for a pattern in its output.

        Without lines, wait for it in the output of the last ones.
        """
        if name not in self._terminals:
            shell = self._start("shell", "--in", str(self.workspace), stdin=subprocess.PIPE)
            self._terminals[name] = shell
        terminal = self._terminals[name]
        if lines:
            self._begin[name] = len(terminal.output)
        if lines == CTRL_C:
            interrupt(terminal.pid)
        elif lines:
            terminal.type(lines)

        printed = lambda: terminal.output[self._begin[name] :]  # noqa: E731
        shown = lambda pattern=seen: re.search(pattern, printed(), re.MULTILINE)  # noqa: E731
        if name == SHORT or seen == END:
            terminal.type("echo done-$((1000 + 7))")
            wait_for(lambda: shown(END), f"its end after {lines!r}", seen=printed)
            assert shown(), f"no {seen!r} after {lines!r}:\n{printed()}"
        wait_for(shown, f"{seen!r} after {lines!r}", seen=printed)

    def close(self, *names):
        for name in names or list(self._terminals):
            self._terminals.pop(name).__exit__()

    def write(self, folder, source):
        """Write the files of a folder `source` into a folder of the workspace's src."""
        for path in source.iterdir():
            shutil.copyfile(path, self.workspace / "src" / folder / path.name)

    def do(self, rows):
        """Type rows of (terminal, lines, pattern to wait for); ("write", folder, source) writes."""
        for name, lines, third in rows:
            if name == "write":
                self.write(lines, third)
            else:
                self.type(name, lines, third)

    def run(self, line):
        """Return a command's output in a new terminal."""
        command = ("run", "--in", str(self.workspace), "bash", "-c", line)
        with self._start(*command) as program:
            program.wait()
            return program.output
