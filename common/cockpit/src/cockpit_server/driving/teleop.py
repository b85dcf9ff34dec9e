"""What the joy2twist of each robot says of itself on /diagnostics."""

from __future__ import annotations

import time
from typing import Any, Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from cockpit_server.clients import Client, Source
from cockpit_server.feeds import Feeds, Raw, read
from cockpit_server.graph import robot_of
from node_kit.arming import DRIVING

MARK = ": joystick"  # the end of the name of joy2twist's status; before it stands its node's
SILENT_S = 4.0  # it publishes once a second
SILENT = {"state": "silent", "why": "no report from joy2twist for 4 s", "level": 2, "deadman": None}
UNKNOWN = "it reports once a second"  # what is shown meanwhile
DEADMAN = "Dead-man button"  # key of the value that names it, or "none"


def said(data: bytes) -> list[tuple[str, dict[str, Any]]]:
    """Return [(robot, {state, why, level, deadman})] of the bytes of a DiagnosticArray."""
    if MARK.encode() not in data:
        return []
    statuses = (read(DiagnosticArray, data) or DiagnosticArray()).status
    found = [status for status in statuses if status.name.endswith(MARK)]
    return [(robot_of(f"/{one.name[: -len(MARK)]}"), report_of(one)) for one in found]


def report_of(status: DiagnosticStatus) -> dict[str, Any]:
    """Return a status as pages get it. deadman: number, "none", or None if not reported."""
    state = status.message.partition(":")[0].partition(" ")[0]
    button = {pair.key: pair.value for pair in status.values}.get(DEADMAN)
    level = int(status.level)
    return {"state": state, "why": status.message, "level": level, "deadman": button}


class Teleop(Source):
    """The newest report of joy2twist about each robot."""

    def __init__(self, feeds: Feeds) -> None:
        self._states: dict[str, dict[str, Any]] = {}  # robot -> its report
        self._heard: dict[str, float] = {}  # robot -> time of its newest message [s]
        feeds.set_subscriptions(self, {"/diagnostics": self._hear}, every=True)

    def collect(self, clients: Sequence[Client], now: float) -> None:
        for robot, heard in list(self._heard.items()):
            if now - heard > SILENT_S:
                self._states[robot] = SILENT

    def newest(self, robot: str) -> dict[str, Any] | None:
        return self._states.get(robot)

    def outdate(self, robot: str) -> None:
        """Forget that joy2twist was driving: the driver of the robot has left."""
        state = self._states.get(robot)
        if state and state["state"] == DRIVING:
            self._states[robot] = {**state, "state": "unknown", "why": UNKNOWN, "level": 1}

    def send_to(self, client: Client, now: float) -> None:
        for robot, state in list(self._states.items()):
            is_shown = client.watch.robots or client.watch.look == robot
            if is_shown and client.take_if_new(f"teleop {robot}", state):
                client.send("teleop", robot=robot, **state)

    def _hear(self, message: Raw, _topic: str) -> None:
        for robot, state in said(message.data):
            self._heard[robot], self._states[robot] = time.monotonic(), state
