"""What the joy2twist of each robot says of itself on /diagnostics."""

from __future__ import annotations

import time

from diagnostic_msgs.msg import DiagnosticArray

from cockpit_server.driving.reasons import Report
from cockpit_server.graph import robot_of
from cockpit_server.ros.feeds import Feeds, Raw, read
from node_kit.rules.arming import DRIVING

MARK = ": joystick"  # the end of the name of joy2twist's status; before it stands its node's
SILENT_S = 4.0  # it publishes once a second
SILENT = Report("silent", "no report from joy2twist for 4 s")
DEADMAN = "Dead-man button"  # key of the value that names it, or "none"


class Teleop:
    """The newest report of joy2twist about each robot."""

    def __init__(self, feeds: Feeds) -> None:
        self._reports: dict[str, tuple[Report, float]] = {}  # robot -> its report, when it came [s]
        feeds.set_subscriptions(self, {"/diagnostics": self._hear}, every=True)

    def newest(self, robot: str, now: float) -> Report | None:
        report, came = self._reports.get(robot, (None, now))
        return SILENT if now - came > SILENT_S else report

    def outdate(self, robot: str) -> None:
        """Forget that joy2twist was driving: the driver of the robot has left."""
        report, came = self._reports.get(robot, (SILENT, 0.0))
        if report.state == DRIVING:  # until the next one
            outdated = report._replace(state="unknown", why="it reports once a second")
            self._reports[robot] = outdated, came

    def _hear(self, message: Raw, _topic: str) -> None:
        found = read(DiagnosticArray, message.data) if MARK.encode() in message.data else None
        for status in found.status if found else ():
            if status.name.endswith(MARK):
                robot = robot_of(f"/{status.name[: -len(MARK)]}")
                state = status.message.partition(":")[0].partition(" ")[0]
                button = {pair.key: pair.value for pair in status.values}.get(DEADMAN)
                report = Report(state, status.message, button)
                self._reports[robot] = report, time.monotonic()
