"""A Kobuki on a pseudo terminal, and the simplest driver of it."""

import contextlib
import os
import tempfile
import time

from kobuki_protocol import commands, robot_packets
from kobuki_protocol.base_control import base_control
from kobuki_protocol.framing import Framer
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, Started
from tutorial_testing.waiting import wait_for


class SerialKobuki(Started):
    """serial_kobuki with its link in a temporary folder: a context manager that ends it."""

    def __init__(self, *arguments, **environment):
        super().__init__()
        folder = self._stack.enter_context(tempfile.TemporaryDirectory())
        self.port = os.path.join(folder, "kobuki")
        command = node_path("fake_turtlebot_sim", "serial_kobuki"), f"_link:={self.port}"
        self._start = lambda: Program(*command, *arguments, **environment)

    def begin(self):
        self.program = self._stack.enter_context(self._start())
        wait_for(lambda: os.path.exists(self.port), "link", seen=lambda: self.program.output)

    def wait_for_line(self, words):
        wait_for(lambda: words in self.program.output, words, seen=lambda: self.program.output)


class Driver:
    """Reads packets and sends commands; a context manager that closes the port."""

    def __init__(self, port):
        self._port, self._framer = port, Framer()

    def __enter__(self):
        self._descriptor = os.open(self._port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        return self

    def __exit__(self, *_):
        os.close(self._descriptor)

    def read(self):
        """Return the parts of all new packets; EOFError if the cable is unplugged."""
        data = b""
        with contextlib.suppress(BlockingIOError):
            data = os.read(self._descriptor, 1 << 16)
            if not data:
                raise EOFError
        payloads = self._framer.feed(data)
        return [part for payload in payloads for part in robot_packets.parse(payload)]

    def wait_for(self, kind, condition=lambda part: True):
        """Return the next part of a kind for which the condition holds."""
        fits = lambda part: isinstance(part, kind) and condition(part)  # noqa: E731
        return wait_for(lambda: next(filter(fits, self.read()), None), kind.__name__)

    def send(self, *parts):
        os.write(self._descriptor, commands.build(*parts))

    def drive(self, v, w, until):
        """Drive until a condition of the core packet holds; return that packet."""

        def step():
            self.send(base_control(v, w))
            time.sleep(0.02)
            cores = [part for part in self.read() if isinstance(part, robot_packets.feedback.Core)]
            return next(filter(until, cores), None)

        return wait_for(step, "effect of driving")
