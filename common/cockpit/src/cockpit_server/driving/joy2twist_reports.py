"""What the joy2twist of a robot reports about itself on /diagnostics."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray

from cockpit_server.driving.reasons import Report
from cockpit_server.graph import robot_of
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from node_kit.rules.arming import DRIVING

MARK = ": joystick"  # The name of joy2twist's status is NODE: joystick.
SILENT_S = 4.0  # It publishes once a second.
SILENT = Report("silent", "no report from joy2twist for 4 s")
DEADMAN = "Dead-man button"  # key of the value with its number, or "none"


class Joy2TwistReports:
    """The newest report of joy2twist about each robot."""

    def __init__(self, subscriptions: Subscriptions) -> None:
        self._reports: dict[str, tuple[Report, float]] = {}  # robot -> (report, its arrival [s])
        handlers = {"/diagnostics": self._on_diagnostics}
        subscriptions.set_subscriptions(self, handlers, every=True)

    def newest(self, robot: str, now: float) -> Report | None:
        report, arrived = self._reports.get(robot, (None, now))
        return SILENT if now - arrived > SILENT_S else report

    def outdate(self, robot: str) -> None:
        """Forget that joy2twist was driving, as the driver of the robot has left."""
        report, arrived = self._reports.get(robot, (SILENT, 0.0))
        if report.state == DRIVING:  # until the next report
            outdated = report._replace(state="unknown", why="it reports once a second")
            self._reports[robot] = outdated, arrived

    def _on_diagnostics(self, message: ReceivedMessage) -> None:
        is_about_joysticks = MARK.encode() in message.data
        array = decoded(DiagnosticArray, message.data) if is_about_joysticks else None
        for status in array.status if array else ():
            if status.name.endswith(MARK):
                robot = robot_of(f"/{status.name[: -len(MARK)]}")
                state = status.message.partition(":")[0].partition(" ")[0]
                button = {pair.key: pair.value for pair in status.values}.get(DEADMAN)
                self._reports[robot] = Report(state, status.message, button), message.arrived
