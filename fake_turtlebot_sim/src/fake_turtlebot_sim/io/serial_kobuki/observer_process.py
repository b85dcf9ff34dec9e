"""The process that connects the device to ROS: one line of JSON for each state and each request.

The device itself needs no master, and no master can disturb it. Its observer, a separate process,
is a node, which starts again with each master (fake_turtlebot_sim.ros.serial_kobuki_observer).
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from typing import Any, Iterator, Sequence

OBSERVER = "fake_turtlebot_sim.ros.serial_kobuki_observer"
READ_BYTES = 65536


class ObserverProcess:
    """The observer's process, and a pipe in each direction."""

    def __init__(self, arguments: Sequence[str]) -> None:
        """Start the process with the arguments of this program's command line."""
        to_read, down = os.pipe()
        self._up, to_write = os.pipe()
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        self._process = subprocess.Popen(
            [sys.executable, "-m", OBSERVER, str(to_write), *arguments],
            stdin=to_read,
            pass_fds=[to_write],
            env=environment,
        )
        os.close(to_read)
        os.close(to_write)
        self._down = down
        for pipe in (self._down, self._up):
            os.set_blocking(pipe, False)
        self._rest = b""
        self.has_ended = False

    @property
    def descriptor(self) -> int:
        """Return the file descriptor of the requests, for select()."""
        return self._up

    def show(self, state: dict[str, Any]) -> None:
        """Send a state; it is dropped while the observer does not read."""
        with suppress(OSError):
            os.write(self._down, json.dumps(state).encode() + b"\n")  # the whole line, or nothing

    def requests(self) -> Iterator[list[Any]]:
        """Yield each request that has arrived: its name and its values."""
        with suppress(BlockingIOError):
            data = os.read(self._up, READ_BYTES)
            self.has_ended = not data
            *lines, self._rest = (self._rest + data).split(b"\n")
            yield from map(json.loads, lines)

    @property
    def was_asked_to_end(self) -> bool:
        """Return whether the process has exited because a master or another node asked it to."""
        return self._process.wait() == 0

    def close(self) -> None:
        """End the input of the process, which then exits."""
        os.close(self._down)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(2.0)
