"""Run students' programs: with limits, with bounded output, and always ended.

A single thread does it all: each wait also reads what the programs print, so that none blocks on
its output, and endless output costs only the reading.
"""

from __future__ import annotations

import contextlib
import functools
import os
import selectors
import signal
import subprocess
import sys
import time
from subprocess import DEVNULL, PIPE, STDOUT
from typing import Callable, Iterable, Iterator, Mapping, Sequence, TypeVar

from tutorial_check.errors import MULTIPLIES, CutShort
from tutorial_check.processes.cpu_clock import CpuClock, fields_of
from tutorial_check.processes.started_program import Program
from tutorial_check.sandbox import landlock, privileges

GRACE_S = 3.0  # after Ctrl-C a program has this long to exit
IDLE_S = 2.0  # programs idle for this long wait in vain; a talker may sleep for 1 s
MOST_PROCESSES = 100  # a launch file starts about a dozen
ENDED = (b"Z", b"X")  # states of processes that have exited
Value = TypeVar("Value")


class Runner:
    """All programs of one worker."""

    def __init__(
        self, environment: Mapping[str, str], alone: bool, reader: int, ruleset: int | None
    ) -> None:
        """alone: in a PID namespace of their own. reader: a socket whose other end waits for the
        replies. ruleset: see landlock.
        """
        self.environment = environment
        self._alone, self._ruleset = alone, ruleset
        self._limits = privileges.limits_of_programs()
        self._open: list[Program] = []
        self.has_started = False  # a student's program
        # Not ended: our processes, and helpers, which lead sessions of their own.
        self.trusted = {os.getsid(0), os.getpid()}
        self.clock = CpuClock(self.trusted)
        self._selector = selectors.PollSelector()  # what programs print
        self._selector.register(reader, selectors.EVENT_READ)

    def start(
        self,
        command: Sequence[str],
        environment: Mapping[str, str] | None = None,
        trusted: bool = False,
        stdin: int = DEVNULL,
        limits: Mapping[int, int] | None = None,
    ) -> Program:
        """Start a program. stdin: a descriptor. limits: lower ones than other programs have.

        Raises OSError if the program does not exist.
        """
        restrict = functools.partial(self._restrict, {**self._limits, **(limits or {})})
        self.has_started |= not trusted
        process = subprocess.Popen(
            command,
            bufsize=0,
            stdin=stdin,
            stdout=PIPE,
            stderr=STDOUT,
            cwd=self.environment["HOME"],
            env={**self.environment, **(environment or {})},
            start_new_session=True,  # with a process group for Ctrl-C, as in a terminal
            preexec_fn=None if trusted else restrict,  # noqa: PLW1509  one thread
        )
        if trusted:
            self.trusted.add(process.pid)
        program = Program(process, os.path.basename(command[0]))
        self._open.append(program)
        os.set_blocking(program.pipe.fileno(), False)
        self._selector.register(program.pipe, selectors.EVENT_READ, program)
        return program

    def _restrict(self, limits: Mapping[int, int]) -> None:
        """Set limits and rights, in the child, before the student's program runs."""
        for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        privileges.limit(limits)
        privileges.give_up_rights()
        if self._ruleset is not None:
            landlock.confine(self._ruleset)
        elif self._alone:
            landlock.confine_sockets()

    def wait(
        self, condition: Callable[[], Value], deadline_s: float, or_idle: bool = False
    ) -> Value:
        """Return the first true value of condition(), or its value at the deadline, by CpuClock.

        or_idle: also stop when the programs have been idle for IDLE_S. Raises CutShort if one
        multiplies without end, SystemExit if the reader has closed; clear() ends what was started.
        """
        began_s = self.clock.now()
        while True:
            waited_s = self.clock.now() - began_s
            is_over = waited_s > deadline_s and not self.clock.starved()
            if or_idle and waited_s > IDLE_S:
                is_over = is_over or self.clock.idle_s() > IDLE_S
            asked_s = time.monotonic()
            value = condition()
            if value or is_over:
                return value
            if self._alone and self.clock.crowd() > MOST_PROCESSES:
                self._reap()  # those that have exited do not count
                if len(self._strays()) > MOST_PROCESSES:
                    raise CutShort(MULTIPLIES, f"more than {MOST_PROCESSES} processes")
            # Evaluating the condition takes CPU time from the programs.
            for key, _ in self._selector.select(max(0.01, 2 * (time.monotonic() - asked_s))):
                if key.data is None:  # it sends no question before the reply, so it has closed
                    sys.exit("the checker has ended")
                self._read(key.data)

    def _read(self, program: Program, is_last: bool = False) -> None:
        if not program.pipe.closed and (not program.read() or is_last):
            self._selector.unregister(program.pipe)
            program.pipe.close()

    def end(self, program: Program, grace_s: float = GRACE_S) -> float | None:
        """End a program; return how long it took after Ctrl-C [s], or None if it was killed."""
        return self.end_all([program], grace_s)[0]

    def end_all(self, programs: Sequence[Program], grace_s: float = GRACE_S) -> list[float | None]:
        """End several programs at once; return how long each took."""
        began_s = time.monotonic()
        took_s: dict[Program, float] = {}
        for program in programs:
            program.stop(signal.SIGINT)

        def all_ended() -> bool:
            for program in programs:
                if program.ended:
                    took_s.setdefault(program, time.monotonic() - began_s)
            return len(took_s) == len(programs)

        self.wait(all_ended, grace_s)
        for program in programs:  # also what it left behind in its process group
            program.signal(signal.SIGKILL)
            program.process.wait()
            self._read(program)  # at most a pipe's size is left, which one read takes
        return [took_s.get(program) for program in programs]

    def clear(self) -> None:
        """End every process that is left, whatever started it."""
        for program in self._open:
            program.stop(signal.SIGKILL)
        self.end_strays()
        for program in self._open:
            program.process.wait()
            self._read(program, is_last=True)
        self._open.clear()
        self._reap()

    def end_strays(self) -> None:
        """End what programs have started and left behind, and programs that still run."""
        for _ in range(100):
            stopped: set[int] = set()
            # A fork bomb reaches its limit of processes.
            while new := set(self._strays()) - stopped:
                _signal(new, signal.SIGSTOP)
                stopped |= new
            if not stopped:
                break
            _signal(stopped, signal.SIGKILL)

    def _reap(self) -> None:
        """Reap orphans that have exited: until then they count towards the user's limit."""
        known = {program.process.pid for program in self._open} | self.trusted
        for pid, state, parent, _ in processes():
            if state in ENDED and parent == os.getpid() and pid not in known:
                with contextlib.suppress(ChildProcessError):
                    os.waitpid(pid, os.WNOHANG)

    def _strays(self) -> list[int]:
        """Return the ids of living descendants; orphans become children of this process."""
        visible, ours = list(processes()), {os.getpid()}
        below: set[int] = set()
        while more := {pid for pid, _, parent, _ in visible if parent in below | ours} - below:
            below |= more
        living = [(pid, session) for pid, state, _, session in visible if state not in ENDED]
        return [pid for pid, own in living if pid in below and own not in self.trusted]


def _signal(pids: Iterable[int], number: int) -> None:
    for pid in pids:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(pid, number)


def processes() -> Iterator[tuple[int, bytes, int, int]]:
    """Yield (id, state, parent, session) of each visible process."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError):  # it has ended
            state, parent, _, session = fields_of(f"/proc/{pid}/stat")[:4]
            yield int(pid), state, int(parent), int(session)
