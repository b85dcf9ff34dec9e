"""Examine a submission in a separate process, so that no student's file can block the checker.

The process reads the submission and judges it, with limited memory and CPU time. If it exceeds
them, for example in a regular expression that no signal interrupts, Linux ends it together with
what it started. The checks of other students go on.
"""

from __future__ import annotations

import compileall
import contextlib
import os
import re
import signal
import socket
import subprocess
import sys
import threading
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from tutorial_check.checking.results import Outcome, Result
from tutorial_check.course.definition import SOLUTIONS
from tutorial_check.errors import CannotCheck, fault
from tutorial_check.examining import judging
from tutorial_check.recording.launcher import sourced
from tutorial_check.recording.worker_process import END_S, no_more
from tutorial_check.sandbox import privileges
from tutorial_check.submission.order import Order

NOT_COMPILED = re.compile(SOLUTIONS)  # folder of a course
PERIOD_S = 0.2  # how often to look at no_more
TOO_LONG = f"reading it takes more than {privileges.MOST_CPU_S} s"
TOO_MUCH = f"reading it takes more than {privileges.MOST_MB} MB of memory"
Message = Any  # (Outcome, its new Result), at the end the Outcomes, or a CannotCheck


def examine(
    order: Order, report: judging.Report = judging.silent, side_by_side: bool = False
) -> list[Outcome]:
    """Return the Outcomes of judging.examine, run in another process. Raises CannotCheck."""
    # Compiled here, because the process's CPU time is for the student's files.
    for folder in (Path(__file__).parents[1], order.course):
        compileall.compile_dir(folder, quiet=2, rx=NOT_COMPILED)
    with _process() as (process, line):
        line.send((sourced(order), side_by_side))
        while True:
            answer = _answer(process, line)
            if isinstance(answer, CannotCheck):
                raise answer
            if isinstance(answer, list):
                return answer
            report(*answer)


@contextlib.contextmanager
def _process() -> Any:
    """Yield (the process, the connection to it); at exit, end it and what it started."""
    ours, theirs = socket.socketpair()
    words = [sys.executable, "-s", "-m", "tutorial_check.examining.examination"]
    # In a session of its own: Ctrl-C ends us, and then the closed connection ends it.
    about: dict[str, Any] = {"stdin": subprocess.DEVNULL, "start_new_session": True}
    process = subprocess.Popen([*words, str(theirs.fileno())], pass_fds=[theirs.fileno()], **about)
    theirs.close()
    line = Connection(ours.detach())
    try:
        yield process, line
    finally:
        line.close()
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(2 * END_S)  # It ends its own processes first.
        finally:
            process.kill()
            process.wait()


def _answer(process: subprocess.Popen[bytes], line: Connection) -> Message:
    """Return the next message. Raises CannotCheck if no more come."""
    try:
        while not line.poll(PERIOD_S):
            if no_more.is_set():
                raise CannotCheck("it was ended")
        return line.recv()
    except (EOFError, OSError):
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(END_S)
    code = process.poll()
    if code is None:
        raise CannotCheck("the process that reads it no longer answers")
    if code == -signal.SIGXCPU:
        raise CannotCheck(TOO_LONG)
    how = signal.strsignal(-code) if code < 0 else f"exit code {code}"
    raise CannotCheck(f"the process that reads it has ended: {how}")


def _end_with(line: Connection) -> None:
    """When the other end is closed, end this process and what it started, as Ctrl-C does."""
    with contextlib.suppress(EOFError, OSError):
        line.recv()
    no_more.set()
    os.kill(os.getpid(), signal.SIGINT)


def main() -> None:
    """Examine an order from the connection whose descriptor is the argument; send the results."""
    line = Connection(int(sys.argv[1]))
    os.set_inheritable(line.fileno(), False)
    order, side_by_side = line.recv()
    privileges.limit_reader()
    threading.Thread(target=_end_with, args=[line], daemon=True).start()

    def report(outcome: Outcome, result: Result) -> None:
        line.send((outcome, result))

    try:
        answer: Message = judging.examine(order, report, side_by_side)
    except CannotCheck as error:
        answer = error
    except MemoryError:
        answer = CannotCheck(TOO_MUCH)
    except Exception as error:
        answer = CannotCheck(f"{fault(error)}: a fault of the check, not of the exercises")
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the connection may close before we end
    line.send(answer)


if __name__ == "__main__":
    # The other end closes before it sends an order if the underlay is missing.
    with contextlib.suppress(KeyboardInterrupt, BrokenPipeError, EOFError):
        main()
