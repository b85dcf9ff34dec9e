"""The node cmd_vel_mux: ROS around the rules in mux/."""

from __future__ import annotations

import threading
import time
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from fake_turtlebot_sim.mux.arbitration import IDLE, Arbiter, PublishingNode, Ruling
from fake_turtlebot_sim.mux.parameters import MuxParameters, parse_mux_parameters
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.connections import is_remote, report_bad_messages, sender_of
from node_kit.ros.rospy_patches.fresh_only import FreshOnly
from node_kit.ros.rospy_patches.prompt_publisher import VelocityPublisher, is_hold_to_run
from node_kit.rules.arming import ZERO, Velocity
from node_kit.rules.throttle import ThrottleEach

NODE_NAME = "cmd_vel_mux"
SHUTDOWN_CHECK_S = 0.1  # how long a shutdown may go unnoticed
WARNING_PERIOD_S = 10.0  # between two equal warnings about an input, at least
BURST = 100  # queued commands: only those that arrive together are known to be late


class CmdVelMux:
    """Lets one of several sources of velocity commands drive, as yocs_cmd_vel_mux does.

    Subscribers: ~TOPIC (geometry_msgs/Twist) for each topic in ~subscribers
    Publishers: ~output (geometry_msgs/Twist) or what ~publisher says, ~active (std_msgs/String)
    Parameters: ~subscribers, ~publisher output; README.md gives units and meanings
    """

    def __init__(self, parameters: MuxParameters) -> None:
        """Subscribe to the inputs; from now on commands go through."""
        self._arbiter = Arbiter(parameters.subscribers)
        self._log = Log()
        report_bad_messages(self._log.warn)
        self._may_warn = ThrottleEach(1.0 / WARNING_PERIOD_S)
        self._lock = threading.Lock()  # one command at a time, and none after the last zero
        self._has_ended = False
        self._fresh = FreshOnly()
        self._wake = threading.Event()  # set when a command waits
        self._output = VelocityPublisher(_in_own_namespace(parameters.publisher), self._log.warn)
        # A state may be latched, unlike a velocity; the queue holds a burst of changes.
        self._active = rospy.Publisher("~active", String, queue_size=10, latch=True)
        self._last_active = ""
        rospy.on_shutdown(self._end)
        self._look()
        self._subscribers: dict[str, Any] = {}
        for source in parameters.subscribers:
            self._subscribers[source.name] = subscriber = rospy.Subscriber(
                _in_own_namespace(source.topic), Twist, self._on_command, callback_args=source.name,
                queue_size=BURST, tcp_nodelay=True,
            )  # fmt: skip
            self._fresh.watch(subscriber)

    def spin(self) -> None:
        """Notice inputs that fall silent, by the monotonic clock, until shut down."""
        while not rospy.is_shutdown():
            self._wake.wait(min(self._look(), SHUTDOWN_CHECK_S))

    def _on_command(self, twist: Any, name: str) -> None:
        linear, angular = twist.linear, twist.angular
        velocity: Velocity = (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
        subscriber = self._subscribers.get(name)  # None until its constructor returns
        is_far = bool(subscriber) and is_remote(subscriber, twist)
        node = PublishingNode(sender_of(twist), is_hold_to_run(twist), is_far)
        with self._lock:
            now = time.monotonic()
            self._notice_suspension()
            if self._fresh.is_old(twist):
                return
            ruling = self._arbiter.command(name, velocity, now, node)
            active = self._arbiter.active(now)
            if ruling is Ruling.OBEYED:
                self._drive(velocity, node)
            elif ruling is Ruling.LATE and active == name:
                self._drive(ZERO, node)  # the first late command may have gone through
            elif ruling is Ruling.WAITS:
                self._wake.set()
            self._report(active)
        if ruling in (Ruling.REJECTED, Ruling.LATE):
            line = f"{name}: {ruling.value}"
            if self._may_warn.ready(line, now):
                self._log.warn(line)

    def _drive(self, velocity: Velocity, node: PublishingNode) -> None:
        """Publish; a program moves a robot that has reconnected, a held stick does not."""
        if not self._has_ended:
            is_stick = node.is_stick
            self._output.publish(velocity, velocity == ZERO or not is_stick, is_stick)

    def _notice_suspension(self) -> None:
        """Stop the robot if this process was suspended: the messages in its sockets are old."""
        if self._fresh.notice():
            self._output.publish(ZERO)
            self._log.warn("This node was suspended. Commands sent meanwhile are ignored.")

    def _look(self) -> float:
        """Act on silence; return the time [s] until the next action may be due."""
        self._wake.clear()
        with self._lock:
            now = time.monotonic()
            self._notice_suspension()
            for velocity, node in self._arbiter.waited(now):
                self._drive(velocity, node)
            if self._arbiter.must_stop(now) and not self._has_ended:
                self._output.publish(ZERO)
            self._report(self._arbiter.active(now))
            return self._arbiter.lull(now)

    def _report(self, active: str) -> None:
        if active != self._last_active and not self._has_ended:
            self._last_active = active
            self._active.publish(active)

    def _end(self) -> None:
        with self._lock:
            self._output.publish(ZERO)  # no later command stops the robot
            self._report(IDLE)
            self._has_ended = True


def _in_own_namespace(topic: str) -> str:
    return topic if topic.startswith("/") else f"~{topic}"


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, parse_mux_parameters, lambda p: CmdVelMux(p).spin(), keeps_name=True)
