"""rosrun ros2_bridge bridge: starts both sides, and restarts the one that exits.

Each side is a separate process. This process has no topics: it is not a node.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from node_kit import ros2_python

PACKAGE = Path(__file__).resolve().parents[1]
AGAIN_S = 1.0  # least time between two starts of a side
LOOK_S = 0.1
GONE_S = 3.0  # time for a side to exit
CANNOT_START = 1  # exit code of a node that has reported why


class Side:
    """A process that can be restarted when it exits."""

    def __init__(self, name: str, command: list[str]) -> None:
        """Start it."""
        self.name, self._command = name, command
        self.start()

    def start(self) -> None:
        """Start it, or restart it."""
        self._began_s = time.monotonic()
        self.process = subprocess.Popen(self._command, stdin=subprocess.DEVNULL)

    @property
    def is_due(self) -> bool:
        """Whether it has exited and may be restarted."""
        return self.process.poll() is not None and time.monotonic() - self._began_s > AGAIN_S

    def end(self) -> None:
        """End it, by force if necessary."""
        self.process.terminate()
        try:
            self.process.wait(GONE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def main() -> int:
    """Run until a signal, or until the node of ROS 1 is shut down; return the exit code."""
    if not ros2_python.is_there():
        print("bridge: no ROS 2 here yet: ./tutorial ros2 --yes sets it up", file=sys.stderr)
        return CANNOT_START
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    with tempfile.TemporaryDirectory(prefix="ros2_bridge_") as folder:
        ros1 = [sys.executable, "-m", "ros2_bridge.ros.ros1_side", folder, *sys.argv[1:]]
        Path(folder, PACKAGE.name).symlink_to(PACKAGE)  # its own folder also has ROS 1
        words = ["-m", "ros2_bridge.ros.ros2_side", folder]
        ros2 = ros2_python.command(words, path=folder)
        sides = [Side("ROS 1", ros1), Side("ROS 2", ros2)]
        try:
            return _watch(sides, Path(folder, "socket"))
        except KeyboardInterrupt:
            return 0
        finally:
            for number in (signal.SIGINT, signal.SIGTERM):
                signal.signal(number, signal.SIG_IGN)
            for side in sides:
                side.end()


def _watch(sides: list[Side], listens: Path) -> int:
    """Restart what exits; return an exit code once the node of ROS 1 is shut down.

    listens: a file that exists once that node has started.
    """
    while True:
        time.sleep(LOOK_S)
        for side in sides:
            if not side.is_due:
                continue
            code = side.process.returncode
            is_node = side is sides[0]
            if is_node and (code == 0 or (code == CANNOT_START and not listens.exists())):
                return int(code)
            how = f"signal {-code}" if code < 0 else f"exit code {code}"
            line = f"bridge: the side of {side.name} has ended ({how}): it is restarted"
            print(line, file=sys.stderr, flush=True)
            side.start()
