#!/usr/bin/python3
"""Displays which bumper of the robot is pressed or released."""

import rospy
from kobuki_msgs.msg import BumperEvent

SIDES = {BumperEvent.LEFT: "left", BumperEvent.CENTER: "center", BumperEvent.RIGHT: "right"}


def callback(event):
    """Display an event: one comes for each change of a bumper."""
    change = "pressed" if event.state == BumperEvent.PRESSED else "released"
    rospy.loginfo("%s bumper %s", SIDES[event.bumper], change)


if __name__ == "__main__":
    rospy.init_node("bumper")
    rospy.Subscriber("mobile_base/events/bumper", BumperEvent, callback)
    rospy.spin()
