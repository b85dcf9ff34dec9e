#!/usr/bin/python3
"""Step 1: subscribe to joy and display the axes of every message."""

import rospy
from sensor_msgs.msg import Joy


def callback(joy):
    """Display the name of the node and all axes, however many the joystick has."""
    axes = ", ".join(f"{value:.2f}" for value in joy.axes)
    rospy.loginfo("%s: Get from Joy [%s]", rospy.get_name(), axes)


def listener():
    """Hand every joy message to callback() until the node is stopped."""
    rospy.init_node("listener", anonymous=True)
    rospy.Subscriber("joy", Joy, callback)
    rospy.spin()


if __name__ == "__main__":
    listener()
