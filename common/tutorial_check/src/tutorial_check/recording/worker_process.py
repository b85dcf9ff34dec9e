"""The process of a worker, which records in isolation."""

from __future__ import annotations

import contextlib
import json
import os
import select
import signal
import socket
import subprocess
import tempfile
import threading
import time

from tutorial_check.data.json_data import as_json, from_json
from tutorial_check.data.recorders import BUILT
from tutorial_check.errors import CannotCheck, Ended
from tutorial_check.recording.build_store import BuildStore
from tutorial_check.sandbox import bubblewrap, privileges
from tutorial_check.submission import cpp_tree
from tutorial_check.submission.order import Order, Question, Reply

# All exercises take 90 s on two idle CPUs. Ten times that is enough: programs that get less than a
# seventh of the CPU time get no verdict anyway (cpu_clock.OVERLOADED), and a student waits.
LONGEST_S = 900.0
MOST_BYTES = 1 << 26  # of a reply; the largest of the handout's takes 1 MB
END_S = 10.0  # a worker that is stopped has this long to end what it started
# Ends the workers of all threads, also those that have just started; each raises CannotCheck.
no_more = threading.Event()


class Worker:
    """A worker's process."""

    def __init__(self, order: Order, wrapper: list[str], store: BuildStore | None = None) -> None:
        """Start it. wrapper: the words before its command, which isolate it."""
        self._store = store
        descriptors = store.descriptors if store else []
        numbers = map(str, descriptors)
        if not order.sandbox.in_namespaces:
            privileges.keep_to_itself()  # and its end of the socket
        environment = {**order.sandbox.environment, "LANG": os.environ.get("LANG", "C.UTF-8")}
        # ROS reads these as it loads.
        own = str(order.folder / "ours")
        environment.update(HOME=own, ROS_HOME=own, ROS_LOG_DIR=own, ROS_IP="127.0.0.1")
        libraries = environment.get("PYTHONPATH", ""), str(cpp_tree.folder() or "")
        environment["PYTHONPATH"] = ":".join(filter(None, libraries))
        environment.update(PATH="/usr/bin:/bin:/usr/sbin:/sbin", PYTHONDONTWRITEBYTECODE="1")
        environment["LC_MESSAGES"] = "C.UTF-8"  # the checker reads English
        self._order, self._buffer = order, b""
        self._end_s = time.monotonic() + LONGEST_S
        self._log = tempfile.TemporaryFile("w+")  # noqa: SIM115  closed by __exit__
        # No pipe: it has a path in /proc, to which a program could plant a link.
        self._line, theirs = socket.socketpair()
        self._line.settimeout(END_S)  # for a worker that does not read
        namespaces = bubblewrap.granted().descriptors if order.sandbox.in_namespaces else ()
        self._process = subprocess.Popen(
            # -s: without the home folder's packages from pip, which may not be visible
            [*wrapper, "/usr/bin/python3", "-s", "-m", "tutorial_check.recording.worker", *numbers],
            stdin=subprocess.DEVNULL,
            stdout=theirs.fileno(),
            stderr=self._log,
            env=environment,
            start_new_session=True,
            pass_fds=(*namespaces, *descriptors),
            cwd="/",
        )
        theirs.close()

    def __enter__(self) -> Worker:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self.end()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(END_S)
        finally:
            self._kill()
            self._process.wait()
            self._line.close()
            self._log.close()

    def end(self) -> None:
        """Stop it: a caller that waits for a reply gets Ended."""
        with contextlib.suppress(OSError):  # it has ended
            self._line.shutdown(socket.SHUT_RDWR)
        if self._order.sandbox.in_namespaces:
            self._kill()

    def _kill(self) -> None:
        if self._process.poll() is None:
            # This ends its namespaces. The whole group, because bubblewrap's child would otherwise
            # wait forever for a parent that has ended.
            os.killpg(self._process.pid, signal.SIGKILL)

    def begin(self) -> None:
        """Send the order; wait until it can record. Raises CannotCheck, or Ended."""
        reply = self.ask(self._order)
        if reply.cannot:
            raise CannotCheck(str(reply.cannot))

    def build(self) -> None:
        """Let it build, so that a worker that starts later finds the build."""
        with contextlib.suppress(Ended):  # the next question says so, too
            self.ask(Question(BUILT.name))
            if self._store:
                self._store.keep()

    def ask(self, message: Order | Question) -> Reply:
        """Return the reply to an order or a question. Raises Ended."""
        try:
            self._line.sendall(json.dumps(as_json(message)).encode() + b"\n")
            while b"\n" not in self._buffer:
                self._read()
        except (EOFError, OSError):
            raise Ended(self._last_words()) from None
        line, _, self._buffer = self._buffer.partition(b"\n")
        text = line.decode(errors="replace")
        try:
            return from_json(Reply, json.loads(text))
        except (ValueError, RecursionError):  # a student's program may have written it
            raise Ended(f"the worker's answer is no recording: {text[:60]!r}") from None

    def _read(self) -> None:
        """Read what has arrived. Raises Ended; EOFError or OSError if the worker has ended."""
        if no_more.is_set():
            raise Ended("it was ended")
        if time.monotonic() > self._end_s:
            why = "the machine is too busy"
            raise Ended(f"the check took longer than {LONGEST_S:.0f} s: {why}")
        if select.select([self._line], [], [], 0.2)[0]:
            data = self._line.recv(1 << 20)
            if not data:
                raise EOFError
            self._buffer += data
            if len(self._buffer) > MOST_BYTES:
                raise Ended(f"the worker's answer is longer than {MOST_BYTES:,} bytes")

    def _last_words(self) -> str:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(END_S)
        self._log.seek(0)
        last = ["", *filter(str.strip, self._log.read()[-2000:].splitlines())][-1]
        return f"the worker exited without a result: {last}"
