"""The process beside the device, which a master sees: a line of JSON for each state and each wish.

The device itself needs no master, and none can disturb it: a process of its own talks to ROS, and
begins again when the master does (fake_turtlebot_sim.ros.serial_kobuki_observer).
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
    """The observer's process, and the two pipes to it."""

    def __init__(self, arguments: Sequence[str]) -> None:
        """Start it with the arguments of this program's command line."""
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
        """Return the file descriptor of the wishes, for select.poll()."""
        return self._up

    def show(self, state: dict[str, Any]) -> None:
        """Send a state; it is dropped if the observer does not read."""
        with suppress(OSError):
            os.write(self._down, json.dumps(state).encode() + b"\n")  # whole, or not at all

    def wishes(self) -> Iterator[list[Any]]:
        """Yield what arrived: the name of a wish and its values."""
        with suppress(BlockingIOError):
            data = os.read(self._up, READ_BYTES)
            self.has_ended = not data
            *lines, self._rest = (self._rest + data).split(b"\n")
            yield from map(json.loads, lines)

    @property
    def was_asked_to_end(self) -> bool:
        """Return whether it has ended because a master or another node asked it to."""
        return self._process.wait() == 0

    def close(self) -> None:
        """Let it end: its input does."""
        os.close(self._down)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(2.0)
