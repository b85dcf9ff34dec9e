"""The node of serial_kobuki: publishes the robot's true pose, and passes requests to the device.

It is a separate process, which runs as long as the device does, waits for a master, and starts
again with each new one. It reads the states of the device from standard input, one line of JSON
each, and writes requests to the file descriptor given as its first argument.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
from typing import Any, Callable

import rosgraph
import rospy
from kobuki_msgs.msg import ButtonEvent
from nav_msgs.msg import Odometry
from std_srvs import srv

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.serial_kobuki.parameters import (
    NODE_NAME,
    SerialKobukiParameters,
    parse_parameters,
)
from fake_turtlebot_sim.simulator.simulated_robot import RobotState
from kobuki_protocol.odometry_messages import fill_odometry
from node_kit.ros.graph.ros_api import call
from node_kit.ros.lifecycle.start import run
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher
from node_kit.rules.answer import Answer

ARGUMENTS = sys.argv[1:]
LOOK_S = 1.0  # between two looks for a master
# Services of type std_srvs/SetBool: name, and the answers to false and true.
SWITCHES = {
    "switch_on": ("off", "on"),
    "plug_in": ("the cable is out", "the cable is in"),
    "charge": ("not charging", "charging at the dock"),
    "send_garbage": ("packets", "garbage in place of packets"),
}


class RequestWriter:
    """Sends requests to the device."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor

    def send(self, name: str, *values: Any) -> None:
        """Send a request: its name and its values."""
        os.write(self._descriptor, json.dumps([name, *values]).encode() + b"\n")


class StateReader:
    """Reads the states of the device in a thread, until the device exits."""

    def __init__(self) -> None:
        self.receive: Callable[[dict[str, Any]], None] = lambda state: None
        self.end: Callable[[], object] = lambda: os._exit(0)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in sys.stdin:
            try:
                state = json.loads(line)
            except ValueError:
                continue  # the rest of a line that another process began to read
            self.receive(state)
        self.end()


class Observer:
    """The topics and services of the device.

    Publishers: base_pose_ground_truth (nav_msgs/Odometry)
    Subscribers: mobile_base/press (kobuki_msgs/ButtonEvent)
    Services: ~reset, ~reboot (std_srvs/Empty), ~switch_on, ~plug_in, ~charge, ~send_garbage
        (std_srvs/SetBool)
    """

    def __init__(
        self, parameters: SerialKobukiParameters, states: StateReader, requests: RequestWriter
    ) -> None:
        """Publish each state from now on."""
        self._requests = requests
        self._message = Odometry()
        self._message.header.frame_id = "map" if parameters.world else "odom"
        self._message.child_frame_id = "base_footprint"
        self._truth = PromptPublisher("base_pose_ground_truth", Odometry)
        rospy.Subscriber("mobile_base/press", ButtonEvent, self._on_press)
        for name in ("reset", "reboot"):
            rospy.Service(f"~{name}", srv.Empty, lambda _, name=name: self._on_empty(name))
        for name in SWITCHES:
            rospy.Service(f"~{name}", srv.SetBool, lambda r, name=name: self._on_set(name, r))
        states.receive = self._publish

    def _publish(self, state: dict[str, Any]) -> None:
        if not self._truth.listeners:
            return
        x, y, yaw, v, w = state["truth"]
        truth = RobotState(x, y, yaw, v, w, 0.0, 0.0, 0.0, 0.0)
        seconds, nanoseconds = divmod(state["stamp_ns"], 10**9)
        fill_odometry(self._message, truth, rospy.Time(seconds, nanoseconds))
        self._truth.publish(self._message)

    def _on_press(self, event: ButtonEvent) -> None:
        self._requests.send("press", event.button, event.state == ButtonEvent.PRESSED)

    def _on_empty(self, name: str) -> Any:
        self._requests.send(name)
        return srv.EmptyResponse()

    def _on_set(self, name: str, request: Any) -> Any:
        self._requests.send(name, request.data)
        return srv.SetBoolResponse(True, SWITCHES[name][request.data])


def restart_with_master(uri: str, process: int) -> None:
    """Start this program again once another master answers, which does not know this node."""
    while True:
        time.sleep(LOOK_S)
        answer, now = call(uri, "getPid")
        if answer is Answer.WELL and now != process:
            os.execv(sys.executable, [sys.executable, "-m", __spec__.name, *ARGUMENTS])


def main() -> int:
    """Wait for a master and run as its node; return the exit code."""
    requests, states = RequestWriter(int(sys.argv.pop(1))), StateReader()
    uri = rosgraph.get_master_uri()
    while True:
        answer, process = call(uri, "getPid")
        if answer is Answer.WELL:
            break
        time.sleep(LOOK_S)
    threading.Thread(target=restart_with_master, args=(uri, process), daemon=True).start()

    def observe(parameters: SerialKobukiParameters) -> None:
        Observer(parameters, states, requests)
        states.end = lambda: rospy.signal_shutdown("the device is gone")
        rospy.spin()

    return run(NODE_NAME, parse_parameters, observe, keeps_name=True)


if __name__ == "__main__":
    sys.exit(main())
