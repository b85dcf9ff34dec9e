"""The only thing that pages may publish: joystick messages, one topic for each robot."""

from __future__ import annotations

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.driving.driver_session import Axes, Buttons
from cockpit_server.graph import topic_of
from gamepad.liveness import Trembling
from node_kit.rospy_patches.prompt_publisher import PromptPublisher

FRAME = "cockpit"


class Joysticks:
    """The publisher of sensor_msgs/Joy for the robot that is driven; for others there is none."""

    def __init__(self) -> None:
        self._publishers: dict[str, PromptPublisher] = {}  # by robot; at most one
        self._trembling = Trembling()
        self._message = Joy()
        self._message.header.frame_id = FRAME

    def keep(self, robot: str | None) -> None:
        """Advertise the topic of this robot only (None: of none): the graph shows what drives."""
        for other in set(self._publishers) - {robot}:
            self._publishers.pop(other).end()
        if robot is not None and robot not in self._publishers:
            self._publishers[robot] = PromptPublisher(topic_of(robot, "joy"), Joy)

    def listeners(self, robot: str) -> set[str]:
        publisher = self._publishers.get(robot)
        return publisher.names if publisher else set()

    def send(self, robot: str, axes: Axes, buttons: Buttons) -> None:
        """Publish at once, if it is advertised already; one thread at a time."""
        publisher = self._publishers.get(robot)
        if publisher is None:
            return
        self._message.header.stamp = rospy.Time.now()
        self._message.axes = self._trembling.shown(axes)
        self._message.buttons = buttons
        publisher.publish(self._message)
