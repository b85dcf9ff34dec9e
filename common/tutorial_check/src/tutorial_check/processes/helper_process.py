"""Trusted helpers in forked processes, so that ROS is loaded only once."""

from __future__ import annotations

import functools
import multiprocessing
import os
import signal
import threading
import time
from multiprocessing.connection import Connection
from typing import Any, Callable, Generic, Mapping, TypeVar, cast

from tutorial_check.errors import CannotCheck

ASK_AGAIN_S = 1.0  # then look whether an answer may still come
FORK = multiprocessing.get_context("fork")
Served = TypeVar("Served")


class Remote:
    """A proxy of an object in another process, whose methods call(method, *arguments) calls."""

    def __init__(self, call: Callable[..., object]) -> None:
        self._call = call

    def __getattr__(self, method: str) -> Callable[..., object]:
        return functools.partial(self._call, method)


class Helper(Generic[Served]):
    """An object in a forked process. Its methods are called through a socket: unlike a pipe, it has
    no path in /proc that opens it, to which a student's program could plant a link.
    """

    def __init__(self, make: Callable[[], Served], environment: Mapping[str, str]) -> None:
        """make(): called in the new process, in that environment; returns the object."""
        self.remote = cast(Served, Remote(self.call))
        self._line, theirs = FORK.Pipe()
        self._trouble = ""  # why it must not be called again
        about = (make, environment, theirs, self._line)
        self._process = FORK.Process(target=_serve, args=about, daemon=True)
        self._process.start()
        self.pid: int = self._process.pid or 0
        theirs.close()

    @property
    def ended(self) -> bool:
        return not self._process.is_alive()

    def call(
        self,
        method: str,
        *arguments: object,
        deadline_s: float = 60.0,
        in_vain: Callable[[], bool] = lambda: False,
    ) -> object:
        """Return what the method returns. Raises CannotCheck if it fails or hangs, or has hung.

        in_vain(): whether an answer can never come; called when none has come for a while.
        """
        if self._trouble:  # a late answer would look like the answer to this call
            raise CannotCheck(self._trouble)
        try:
            self._line.send((method, arguments))
            end = time.monotonic() + deadline_s
            while not self._line.poll(min(deadline_s, ASK_AGAIN_S)):
                if time.monotonic() >= end or in_vain():
                    self._trouble = f"the checker's own helper hangs in {method}"
                    raise CannotCheck(self._trouble)
            worked, value = self._line.recv()
        except (EOFError, OSError) as error:
            raise CannotCheck(f"the checker's own helper has ended in {method}: {error}") from None
        if not worked:
            raise CannotCheck(f"the checker's own helper failed in {method}: {value}")
        return value

    def end(self) -> None:
        self._process.kill()
        self._process.join()
        self._line.close()


def _serve(
    make: Callable[[], Any], environment: Mapping[str, str], line: Connection, ours: Connection
) -> None:
    ours.close()  # so that this connection ends with the checker
    os.setsid()
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    os.environ.clear()
    os.environ.update(environment)
    served = None
    while True:
        try:
            method, arguments = line.recv()
        except EOFError:
            os._exit(0)  # whatever ROS threads still run
        try:
            served = served or make()
            line.send((True, getattr(served, method)(*arguments)))
        except Exception as error:
            line.send((False, f"{type(error).__name__}: {error}"))


class MasterProcess:
    """A ROS master in a Helper's process, which ends when rosmaster is asked to shut down."""

    def __init__(self, port: int) -> None:
        from rosmaster.master import Master  # noqa: PLC0415  only where a master is wanted

        self._master = Master(port)
        self._master.start()
        threading.Thread(target=self._end_when_asked, daemon=True).start()

    def _end_when_asked(self) -> None:
        while self._master.ok():
            time.sleep(0.05)
        os._exit(0)

    def uri(self) -> str | None:
        """Return its URI; None if it does not start."""
        end = time.monotonic() + 30
        while self._master.uri is None and time.monotonic() < end:
            time.sleep(0.002)
        return self._master.uri
