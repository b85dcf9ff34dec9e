"""An examination in a process of its own: nothing that a student wrote can keep the checker busy.

The process reads what was handed in, and judges. It has so much memory and processor time; where
that does not suffice, as in a regular expression that no signal ends, Linux ends it, and with it
what it started. Other students of a class, who are checked by the same program, lose nothing.
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
PERIOD_S = 0.2  # How often to look at no_more.
TOO_LONG = f"reading it takes more than {privileges.MOST_CPU_S} s"
TOO_MUCH = f"reading it takes more than {privileges.MOST_MB} MB of memory"
Message = Any  # (an Outcome, a Result that came), the Outcomes at the end, or a CannotCheck


def examine(
    order: Order, report: judging.Report = judging.silent, side_by_side: bool = False
) -> list[Outcome]:
    """Return the Outcomes as judging.examine does, made in another process. Raises CannotCheck."""
    # Compiled before: the time for that must not count as the time for the student's files.
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
    """Yield (the process, the line to it). At the end it has ended, and what it started."""
    ours, theirs = socket.socketpair()
    words = [sys.executable, "-s", "-m", "tutorial_check.examining.examination"]
    # In a session of its own: Ctrl-C ends us, and the closed line ends it.
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
    """Return what comes next. Raises CannotCheck if nothing more comes."""
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
    """End this process as Ctrl-C does, with what it started, when the other end is closed."""
    with contextlib.suppress(EOFError, OSError):
        line.recv()
    no_more.set()
    os.kill(os.getpid(), signal.SIGINT)


def main() -> None:
    """Examine what comes through the line whose descriptor is the argument; send what was found."""
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
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # The line may close before we end.
    line.send(answer)


if __name__ == "__main__":
    # The other end is closed before an order comes if there is nothing to check over.
    with contextlib.suppress(KeyboardInterrupt, BrokenPipeError, EOFError):
        main()
