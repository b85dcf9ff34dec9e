"""Programs of others: started with limits, listened to with a limit, ended for certain.

One thread does it all: each wait also reads what the programs print, so that none of them ever waits
for us, and output without end costs no more than the reading.
"""

from __future__ import annotations

import contextlib
import os
import resource
import select
import signal
import subprocess
import sys
import time
from typing import Callable, Iterator, Mapping, NoReturn, Sequence, TypeVar

from tutorial_check import place
from tutorial_check.model import Wrong
from tutorial_check.patience import Patience
from tutorial_check.running import Forked, Program, fields_of

GRACE_S = 3.0  # after Ctrl-C a program has this long to end by itself
IDLE_S = 2.0  # programs that have done nothing for so long wait for what does not come; a talker may for 1 s
MOST_PROCESSES = 100  # a launch file's are a dozen
ENDED = (b"Z", b"X")  # states of processes that are no more than a number
Value = TypeVar("Value")


class Box:
    """All programs of one check of one workspace."""

    def __init__(
        self,
        environment: Mapping[str, str],
        uid: int | None = None,
        alone: bool = False,
        result: int | None = None,
    ) -> None:
        """uid: under which they run, or None; alone: whether they have a PID namespace of their own.

        result: a socket without whose reader nothing of this is wanted any more.
        """
        self.environment = environment
        self._uid = uid
        self._alone = alone
        self._limits = place.limits_of_programs(uid)
        self._open: list[Program] = []
        self._trusted = {os.getsid(0), os.getpid()}
        self.patience = Patience(self._trusted)
        self._poll = select.poll()
        self._result = result
        if result is not None:
            self._poll.register(
                result, 0
            )  # the end of its reader is an error, which is always reported
        self._reading: dict[int, Program] = {}

    def start(
        self,
        command: Sequence[str],
        environment: Mapping[str, str] | None = None,
        trusted: bool = False,
    ) -> Program:
        """Start a program. Raises OSError if there is nothing to start."""
        read, write = os.pipe()
        try:
            process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=write,
                stderr=write,
                cwd=self.environment["HOME"],
                env={**self.environment, **(environment or {})},
                start_new_session=True,  # with a group that Ctrl-C reaches, as in a terminal
                preexec_fn=place.restore_rights if trusted else self._restrict,  # noqa: PLW1509  one thread
            )
        except BaseException:
            os.close(read)
            raise
        finally:
            os.close(write)
        if trusted:
            self._trusted.add(process.pid)
        return self._listen_to(process, os.path.basename(command[0]), read)

    def fork(
        self, run: Callable[[], NoReturn], environment: Mapping[str, str], name: str
    ) -> Program:
        """Start run() as a program in a copy of this process, which run() has to end."""
        read, write = os.pipe()
        pid = os.fork()
        if pid == 0:
            try:
                os.setsid()
                os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
                for stream in (1, 2):
                    os.dup2(write, stream)
                os.closerange(3, resource.getrlimit(resource.RLIMIT_NOFILE)[0])
                os.environ.clear()
                os.environ.update({**self.environment, **environment})
                self._restrict()
                os.chdir(self.environment["HOME"])
                run()
            finally:
                os._exit(1)
        os.close(write)
        return self._listen_to(Forked(pid), name, read)

    def _listen_to(
        self, process: subprocess.Popen[bytes] | Forked, name: str, descriptor: int
    ) -> Program:
        os.set_blocking(descriptor, False)
        program = Program(process, name, descriptor)
        self._open.append(program)
        self._reading[descriptor] = program
        self._poll.register(descriptor, select.POLLIN | select.POLLHUP)
        return program

    def _restrict(self) -> None:
        """In the child, before the student's program: its limits and its user."""
        for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
            signal.signal(number, signal.SIG_DFL)
        place.limit(self._limits)
        if self._uid is not None:
            os.setgroups([])
            os.setgid(self._uid)
            os.setuid(self._uid)
        place.give_up_rights()

    def trust(self, pid: int) -> None:
        """Leave alone a process that we forked, which leads a session of its own."""
        self._trusted.add(pid)

    def wait(
        self, condition: Callable[[], Value], deadline_s: float, or_idle: bool = False
    ) -> Value:
        """Return the first true value of condition(), or its value at the deadline.

        The deadline goes by the programs' time, see Patience. or_idle: no longer than until they
        have done nothing for IDLE_S. Raises Wrong for a program that multiplies without end.
        """
        began_s = self.patience.now()
        while True:
            waited_s = self.patience.now() - began_s
            is_over = waited_s > deadline_s and not self.patience.starved()
            if or_idle and waited_s > IDLE_S:
                is_over = is_over or self.patience.idle_s() > IDLE_S
            asked_s = time.monotonic()
            value = condition()
            if value or is_over:
                return value
            if self._is_crowded():
                raise Wrong(
                    "a program that is one process, or a few",
                    f"it starts itself again and again: more than {MOST_PROCESSES} processes",
                    hint="where does it call os.fork, or start programs?",
                    sure=True,
                )
            self._pump(
                max(0.01, 2 * (time.monotonic() - asked_s))
            )  # asking takes time from the others

    def _is_crowded(self) -> bool:
        """Return whether the living programs are too many. Reap those that have ended."""
        if not self._alone or self.patience.crowd() <= MOST_PROCESSES:
            return False
        self._reap()
        living = {pid for pid, state, *_ in processes() if state not in ENDED}
        return len(living - self._trusted) > MOST_PROCESSES

    def _pump(self, longest_s: float) -> None:
        """Read what was printed; return when something was, or after the given time.

        Raises SystemExit when it is of no use any more; clear() ends what was started.
        """
        for descriptor, _ in self._poll.poll(longest_s * 1000):
            if descriptor == self._result:
                sys.exit("the checker has ended")
            program = self._reading[descriptor]
            if not program.read():
                self._forget(program)

    def _forget(self, program: Program) -> None:
        if self._reading.pop(program.descriptor, None):
            self._poll.unregister(program.descriptor)
            os.close(program.descriptor)

    def interrupt(self, program: Program) -> None:
        """Press Ctrl-C."""
        _signal_group(program, signal.SIGINT)

    def end(self, program: Program, grace_s: float = GRACE_S) -> float | None:
        """End a program; return how long it took after Ctrl-C [s], or None if it had to be killed."""
        return self.end_all([program], grace_s)[0]

    def end_all(self, programs: Sequence[Program], grace_s: float = GRACE_S) -> list[float | None]:
        """End several at once; return how long each took."""
        began_s = time.monotonic()
        took_s = [0.0] * len(programs)
        for program in programs:
            program.note_work()
            if not program.ended:
                program.was_stopped = True
                self.interrupt(program)

        def all_ended() -> bool:
            for number, program in enumerate(programs):
                if program.ended and not took_s[number]:
                    took_s[number] = time.monotonic() - began_s
            return all(took_s)

        self.wait(all_ended, grace_s)
        for program in programs:
            _signal_group(program, signal.SIGKILL)
            program.process.wait()
            while (
                program.descriptor in self._reading
                and select.select([program.descriptor], [], [], 0)[0]
            ):
                if not program.read():
                    self._forget(program)
        return [took or None for took in took_s]

    def clear(self) -> None:
        """End all that is left, whatever it is called and whatever started it."""
        for program in self._open:
            program.note_work()
            if not program.ended:
                program.was_stopped = True
                _signal_group(program, signal.SIGKILL)
        if self._uid is not None:
            _kill_all_of_user(self._uid)
        for _ in range(50):  # a program that forks without end is faster than one round
            strays = self._strays()
            if not strays:
                break
            for number in (signal.SIGSTOP, signal.SIGKILL):
                for pid in strays:
                    with contextlib.suppress(ProcessLookupError, PermissionError):
                        os.kill(pid, number)
        for program in self._open:
            program.process.wait()
            self._forget(program)
        self._open.clear()
        self._reap()

    def _reap(self) -> None:
        """Reap orphans that have ended: till then they count against the user's limit."""
        known = {program.process.pid for program in self._open} | self._trusted
        for pid, state, parent, _ in processes():
            if state in ENDED and parent == os.getpid() and pid not in known:
                with contextlib.suppress(ChildProcessError):
                    os.waitpid(pid, os.WNOHANG)

    def _strays(self) -> list[int]:
        """Return the ids of what is left: orphans become children of this process."""
        found, below = list(processes()), {os.getpid()}
        more = below
        while more:
            more = {pid for pid, _, parent, _ in found if parent in below} - below
            below |= more
        return [
            pid
            for pid, state, _, session in found
            if pid in below - {os.getpid()} and state not in ENDED and session not in self._trusted
        ]


def _signal_group(program: Program, number: int) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(program.process.pid, number)


def _kill_all_of_user(uid: int) -> None:
    """Kill them at once, so that none can fork meanwhile."""
    pid = os.fork()
    if pid == 0:
        with contextlib.suppress(BaseException):
            os.setuid(uid)
            os.kill(-1, signal.SIGKILL)
        os._exit(0)
    os.waitpid(pid, 0)


def processes() -> Iterator[tuple[int, bytes, int, int]]:
    """Yield id, state, parent, session of each process that can be seen."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError):  # ended meanwhile
            state, parent, _, session = fields_of(f"/proc/{pid}/stat")[:4]
            yield int(pid), state, int(parent), int(session)
