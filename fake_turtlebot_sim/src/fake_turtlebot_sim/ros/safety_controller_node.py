"""The node safety_controller: ROS around the rules in safety/."""

from __future__ import annotations

import threading
import time
from typing import Any

import rospy
from geometry_msgs.msg import Twist, Vector3
from std_msgs.msg import Empty

from fake_turtlebot_sim.safety.parameters import SafetyParameters, parse_parameters
from fake_turtlebot_sim.safety.reaction import Reaction
from kobuki_protocol.events import EVENTS, QUEUE
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.connections import has_sender, report_bad_messages
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

NODE_NAME = "kobuki_safety_controller"
PERIOD_S = 0.1  # as on the Kobuki; the input's timeout in the mux is 0.2 s


class SafetyController:
    """Backs a bumped robot away, through the mux input with the highest priority.

    Subscribers: ~events/bumper (kobuki_msgs/BumperEvent), ~events/cliff (CliffEvent),
        ~events/wheel_drop (WheelDropEvent), ~enable, ~disable, ~reset (std_msgs/Empty)
    Publishers: ~cmd_vel (geometry_msgs/Twist), only while a sensor is active
    Parameters: ~time_to_extend_bump_cliff_events 0 s
    """

    def __init__(self, parameters: SafetyParameters) -> None:
        """Subscribe; from now on the node reacts to events."""
        report_bad_messages(Log().warn)
        self._reaction = Reaction(parameters.time_to_extend_bump_cliff_events)
        self._is_enabled = True
        self._lock = threading.Lock()
        self._publisher = PromptPublisher("~cmd_vel", Twist)
        self._sensors = [
            rospy.Subscriber(
                f"~events/{kind}", message, self._on_event, callback_args=(kind, field),
                queue_size=QUEUE, tcp_nodelay=True,
            )
            for kind, message, field in EVENTS
        ]  # fmt: skip
        for topic in ("enable", "disable", "reset"):
            rospy.Subscriber(f"~{topic}", Empty, self._on_empty, callback_args=topic, queue_size=1)

    def spin(self) -> None:
        """Publish repeatedly while a sensor is active, until shut down."""
        while not rospy.is_shutdown():
            with self._lock:
                if not any(map(has_sender, self._sensors)):
                    self._reaction.reset()  # a base that has exited sends no release
                self._publish()
            time.sleep(PERIOD_S)

    def _on_event(self, event: Any, about: tuple[str, str]) -> None:
        kind, field = about
        with self._lock:
            sensor, is_active = getattr(event, field), bool(event.state)
            self._reaction.event(kind, sensor, is_active, time.monotonic())
            self._publish()

    def _publish(self) -> None:
        velocity = self._reaction.velocity(time.monotonic())
        if velocity is not None and self._is_enabled:
            v, w = velocity
            self._publisher.publish(Twist(Vector3(v, 0.0, 0.0), Vector3(0.0, 0.0, w)))

    def _on_empty(self, _message: Any, topic: str) -> None:
        with self._lock:
            if topic == "reset":
                self._reaction.reset()
            else:
                self._is_enabled = topic == "enable"


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, parse_parameters, lambda p: SafetyController(p).spin(), keeps_name=True)
