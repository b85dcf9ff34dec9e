"""Runs a launch, counts its messages, ends it as Ctrl-C does, and reports what it drove."""

from __future__ import annotations

import contextlib
import signal
import subprocess
import time
from collections.abc import Callable, Iterable
from typing import Any

import rosgraph
import rosnode
import rospy
from nav_msgs.msg import Odometry
from rospy import AnyMsg

from node_kit.ros.rospy_patches.connections import connect_once, sender_of
from tutorial_tools.demo.drive_report import DriveReport
from tutorial_tools.errors import DemoError

TOPICS = ("/joy", "/cmd_vel", "/odom")
START_TIMEOUT_S = 60.0  # until the first odometry, on a slow and busy machine
COMPLETE_TIMEOUT_S = 3.0  # for a launch that is ended while it starts
END_TIMEOUT_S = 30.0  # roslaunch itself kills stubborn nodes after 17 s
# What ends the demonstration: Ctrl-C, kill, a terminal that is closed.
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class DemoLaunch:
    """A launch that runs, with a DriveReport of it; leaving the context ends it as Ctrl-C does."""

    def __init__(self, command: list[str], nodes: Iterable[str]) -> None:
        """command: of roslaunch; nodes: the names of the nodes that it starts."""
        self.summary = ""  # what was driven, once it is over
        self.report = DriveReport(TOPICS)
        self._nodes = set(nodes)
        # In a session of its own: Ctrl-C in a terminal must not reach it before it is complete.
        self._process = subprocess.Popen(command, start_new_session=True)

    def __enter__(self) -> DemoLaunch:
        return self

    def __exit__(self, *_: object) -> None:
        for number in ENDING:
            signal.signal(number, signal.SIG_IGN)  # an impatient user must not leave nodes behind
        # A roslaunch that is interrupted while it still starts nodes leaves its master behind.
        with contextlib.suppress(DemoError):
            self.wait(time.monotonic() + COMPLETE_TIMEOUT_S, self._is_complete)
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        rospy.signal_shutdown("the demonstration is over")

    def _is_complete(self) -> bool:
        try:
            return self._nodes <= set(rosnode.get_node_names())
        except rosnode.ROSNodeIOException:
            return False  # no master yet

    def wait(self, until: float, happened: Callable[[], bool] = lambda: False) -> None:
        """Wait for something to happen, or until a time [s] of the monotonic clock.

        Raises DemoError if the launch ends meanwhile.
        """
        while time.monotonic() < until and not happened():
            if self._process.poll() is not None:
                raise DemoError("the launch ended by itself; its messages above say why")
            time.sleep(0.02)

    def wait_for_odometry(self) -> None:
        """Listen to the topics, until the first odometry arrives."""
        deadline = time.monotonic() + START_TIMEOUT_S
        self.wait(deadline, rosgraph.is_master_online)
        connect_once()
        rospy.init_node("demo", anonymous=True, disable_signals=True, log_level=rospy.ERROR)
        for topic in TOPICS:
            kind = Odometry if topic == "/odom" else AnyMsg
            rospy.Subscriber(topic, kind, self._on_message, topic)
        self.wait(deadline, lambda: self.report.pose is not None)
        if self.report.pose is None:
            raise DemoError(f"no /odom within {START_TIMEOUT_S:.0f} s")
        self.summary = self.report.line(0.0)

    def watch(self, duration_s: float) -> None:
        """Count the messages for a time; however that ends, summary has the result."""
        # A new report: on a busy machine seconds of /joy may precede the first /odom.
        pose, self.report = self.report.pose, DriveReport(TOPICS)
        self.report.pose, began = pose, time.monotonic()
        try:
            self.wait(began + duration_s)
        finally:
            self.summary = self.report.line(time.monotonic() - began)

    def _on_message(self, message: Any, topic: str) -> None:
        if sender_of(message) not in self._nodes:
            return  # another node may publish on the same topic
        self.report.counts[topic] += 1
        if topic == "/odom":
            at, turn = message.pose.pose.position, message.pose.pose.orientation
            self.report.add_pose(at.x, at.y, turn.z, turn.w)
