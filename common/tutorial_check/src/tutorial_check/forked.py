"""Trusted helpers in processes of their own, forked from this one so that ROS is loaded once."""

import contextlib
import os
import pickle
import select
import signal
import socket
import struct
import sys
import threading
import time

from tutorial_check import place
from tutorial_check.model import CannotCheck


def _send(descriptor, thing):
    data = pickle.dumps(thing)
    os.write(descriptor, struct.pack("!I", len(data)))
    view = memoryview(data)
    while view:
        view = view[os.write(descriptor, view) :]


def _receive(descriptor):
    def exactly(count):
        data = b""
        while len(data) < count:
            part = os.read(descriptor, count - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    return pickle.loads(exactly(struct.unpack("!I", exactly(4))[0]))


ASK_AGAIN_S = 1.0  # whether an answer may still come


class Helper:
    """An object in a forked process; its methods are called through a socket that only we have.

    Unlike a pipe, none can be opened by a path in /proc, to which a student's program may plant a link.
    """

    def __init__(self, make, environment):
        """make(): the object, called in the new process, whose environment is given."""
        ours, theirs = socket.socketpair()
        self.pid = os.fork()
        if self.pid == 0:
            try:
                ours.close()
                place.restore_rights()
                _serve(make, environment, theirs.fileno())
            finally:
                os._exit(0)
        theirs.close()
        self._line = ours
        self._hangs = ""

    @property
    def ended(self):
        """Whether its process has ended."""
        return bool(os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT))

    def call(self, method, *arguments, deadline_s=60.0, in_vain=lambda: False):
        """What the method returns. Raises CannotCheck if the helper fails or hangs, or did so once.

        in_vain(): asked when it has not answered for a while; whether it never will.
        """
        if self._hangs:  # what it answers late would be taken for the answer to this
            raise CannotCheck(self._hangs)
        try:
            _send(self._line.fileno(), (method, arguments))
            end = time.monotonic() + deadline_s
            while not select.select([self._line], [], [], min(deadline_s, ASK_AGAIN_S))[0]:
                if time.monotonic() < end and not in_vain():
                    continue
                self._hangs = f"the checker's own helper hangs in {method}"
                raise CannotCheck(self._hangs)
            worked, value = _receive(self._line.fileno())
        except (EOFError, OSError) as error:
            raise CannotCheck(f"the checker's own helper has ended in {method}: {error}") from None
        if not worked:
            raise CannotCheck(f"the checker's own helper failed in {method}: {value}")
        return value

    def end(self):
        """End the process."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        self._line.close()


def _serve(make, environment, line):
    os.setsid()
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    sys.stdout = open(os.devnull, "w")  # noqa: SIM115  for the life of the process
    sys.stderr = sys.stdout
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    os.environ.clear()
    os.environ.update(environment)
    thing = None
    while True:
        try:
            method, arguments = _receive(line)
        except EOFError:
            return
        try:
            if thing is None:
                thing = make()
            _send(line, (True, getattr(thing, method)(*arguments)))
        except Exception as error:
            _send(line, (False, f"{type(error).__name__}: {error}"))


class MasterProcess:
    """A ROS master, in the process of a Helper."""

    def __init__(self, port):
        from rosmaster.master import Master  # noqa: PLC0415  only where a master is wanted

        self._master = Master(port)
        self._master.start()
        threading.Thread(target=self._end_when_told, daemon=True).start()

    def _end_when_told(self):
        """A master that was asked to shut down ends, as rosmaster's own program does."""
        while self._master.ok():
            time.sleep(0.05)
        os._exit(0)

    def uri(self):
        """Where it answers; None if it does not come to that."""
        end = time.monotonic() + 30
        while self._master.uri is None and time.monotonic() < end:
            time.sleep(0.002)
        return self._master.uri
