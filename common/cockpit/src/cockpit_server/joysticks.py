"""The only thing that pages may publish: joystick messages, one topic for each robot."""

import rospy
from sensor_msgs.msg import Joy

from cockpit_server.robots import topic_of
from gamepad.trembling import Trembling
from node_kit.prompt_publisher import PromptPublisher

FRAME = "cockpit"


class Joysticks:
    """Publishers of sensor_msgs/Joy, each advertised once, when it is first needed."""

    def __init__(self):
        """Nothing is advertised yet."""
        self._publishers = {}
        self._trembling = {}  # by robot
        self._message = Joy()
        self._message.header.frame_id = FRAME

    def advertise(self, robot):
        """Make the publisher; it may wait for the master."""
        if robot not in self._publishers:
            self._trembling[robot] = Trembling()
            self._publishers[robot] = PromptPublisher(topic_of(robot, "joy"), Joy)

    def send(self, robot, axes, buttons):
        """Publish at once, if it is advertised already; one thread at a time."""
        publisher = self._publishers.get(robot)
        if publisher is None:
            return
        self._message.header.stamp = rospy.Time.now()
        self._message.axes = self._trembling[robot].shown(axes)
        self._message.buttons = buttons
        publisher.publish(self._message)
