"""The ROS node joy_remap: joy_in (sensor_msgs/Joy) in, joy_out (sensor_msgs/Joy) out."""

from __future__ import annotations

import rospy
from sensor_msgs.msg import Joy

from gamepad.remap.mappings import Mappings, load
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log

NODE_NAME = "joy_remap"


class JoyRemap:
    """Publishes each Joy with the axes and buttons that the formulas give.

    Subscriber: joy_in (sensor_msgs/Joy). Publisher: joy_out (sensor_msgs/Joy)
    Parameters: ~mappings/axes, ~mappings/buttons: lists of formulas, both []
    """

    def __init__(self, mappings: Mappings) -> None:
        """Take the formulas."""
        self._mappings, self._warn = mappings, Log().warn
        self._reported = ""
        self._publisher = rospy.Publisher("joy_out", Joy, queue_size=1)
        rospy.Subscriber("joy_in", Joy, self._on_joy, queue_size=1, tcp_nodelay=True)

    def _on_joy(self, joy: Joy) -> None:
        try:
            axes, buttons = self._mappings.apply({"axes": joy.axes, "buttons": joy.buttons})
        except ValueError as error:
            if str(error) != self._reported:  # each warning once in a row
                self._reported = str(error)
                self._warn(f"a Joy is not passed on: {error}")
            return
        self._publisher.publish(Joy(joy.header, axes, buttons))


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, load, lambda mappings: (JoyRemap(mappings), rospy.spin()))
