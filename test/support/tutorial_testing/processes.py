"""Start programs as a user does in a terminal, and end them as Ctrl-C does."""

import contextlib
import os
import signal
import socket
import subprocess
import tempfile
import time
import uuid
from pathlib import Path

from tutorial_testing.waiting import DEADLINE_S, descendants, wait_for  # noqa: F401  for tests

# As in a terminal: tests in the background inherit an ignored Ctrl-C, which the programs that they
# start would inherit, too.
for number in (signal.SIGINT, signal.SIGHUP):
    if signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, signal.default_int_handler)

REPOSITORY = Path(__file__).resolve().parents[3]
MARK = "STARTED_BY_A_TEST"  # environment variable by which a program's descendants are known


def environment(**more):
    """Return a program's environment, in which Python does not buffer output to a pipe."""
    return {**os.environ, "PYTHONUNBUFFERED": "1", **more}


def lives(pid):
    """Return whether a process exists and is no zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def with_environment(text):
    """Return the ids of the running processes whose environment has this text."""
    pids = []
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # ended meanwhile, or another user's
            if text.encode() in (process / "environ").read_bytes() and lives(process.name):
                pids.append(int(process.name))
    return pids


def command_line(pid):
    """Return the command line of a process; "" if it has exited."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text(errors="replace")
    except OSError:
        return ""


def signal_all(pids, number):
    """Send a signal to those processes that still run; return the time [s] just before."""
    now = time.time()
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, number)
    return now


def suspend(pids):
    """Suspend all threads of processes, as Ctrl-Z does; return the time [s] just before."""
    now = signal_all(pids, signal.SIGSTOP)
    wait_for(lambda: all(map(_is_stopped, pids)), f"end of the work of {pids}")
    return now


@contextlib.contextmanager
def suspended(pids):
    """Suspend processes. A suspended master accepts connections, but does not answer."""
    suspend(pids)
    try:
        yield
    finally:
        signal_all(pids, signal.SIGCONT)


def _is_stopped(pid):
    try:
        threads = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/stat")]
    except OSError:
        return False  # a thread has ended meanwhile
    return all(text.rsplit(")", 1)[1].split()[0] in "TtZ" for text in threads)


class Started:
    """A context manager: self._stack ends what begin() starts, also if begin() fails."""

    def __init__(self):
        self._stack = contextlib.ExitStack()

    def begin(self):
        """Start what is needed."""

    def __enter__(self):
        with contextlib.ExitStack() as attempt:
            attempt.push(self)
            self.begin()
            attempt.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()


class Program:
    """A program and all that it starts, with its output: both streams together.

    Use it as a context manager, so that nothing keeps running after the test.
    """

    def __init__(self, *command, stdin=subprocess.DEVNULL, **more):
        """more: variables of its environment."""
        self._output = tempfile.TemporaryFile("w+")  # noqa: SIM115  closed in __exit__
        self._mark = str(uuid.uuid4())
        self._process = subprocess.Popen(
            command,
            stdin=stdin,
            stdout=self._output,
            stderr=subprocess.STDOUT,
            env=environment(**{**more, MARK: self._mark}),
            start_new_session=True,  # with a process group that Ctrl-C reaches, as in a terminal
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()
        self._output.close()
        if self._process.stdin:
            self._process.stdin.close()

    @property
    def output(self):
        """The output so far."""
        # Not by read(), which would move the position at which the program writes.
        descriptor = self._output.fileno()
        return os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode(errors="replace")

    @property
    def pid(self):
        return self._process.pid

    @property
    def ended(self):
        return self._process.poll() is not None

    def signal(self, number):
        """Send a signal to all processes of this program; return the time [s] just before."""
        return signal_all(self.left_behind(), number)

    def kill(self):
        """Kill all of it, as a lack of memory does; return the time [s] just before."""
        now = self.signal(signal.SIGKILL)
        self._process.wait()
        return now

    def interrupt(self):
        """Press Ctrl-C: send SIGINT to the foreground group."""
        with contextlib.suppress(ProcessLookupError):  # it has ended
            os.killpg(self._process.pid, signal.SIGINT)

    def type(self, line):
        """Type a line into a program that was started with stdin=subprocess.PIPE."""
        self._process.stdin.write(f"{line}\n".encode())
        self._process.stdin.flush()

    def close_input(self):
        """Close the input of such a program."""
        self._process.stdin.close()

    def wait(self, deadline_s=DEADLINE_S):
        """Wait for the end; return the exit code. AssertionError with the output if it is late."""
        what = f"end of {self._process.args}"
        wait_for(lambda: self.ended, what, deadline_s, lambda: self.output)
        return self._process.returncode

    def left_behind(self):
        """Return the ids of all running processes of this program, known by their environment."""
        return with_environment(f"{MARK}={self._mark}")


def free_port():
    """Return a free TCP port of this machine."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
