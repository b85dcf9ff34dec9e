#!/usr/bin/python3
"""Repeats what it receives on the topic chatter; with --unique under the plain name listener."""

import sys

import rospy
from std_msgs.msg import String


def callback(message):
    """Display a message; rospy calls this for every one, in another thread."""
    rospy.loginfo("%s: I heard %s", rospy.get_name(), message.data)


def listen():
    """Hand every message on chatter to callback() until the node is stopped."""
    rospy.init_node("listener", anonymous="--unique" not in sys.argv)
    rospy.Subscriber("chatter", String, callback)
    rospy.spin()  # the callback does the work; this only keeps the program alive


if __name__ == "__main__":
    try:
        listen()
    except rospy.ROSInitException:
        pass  # stopped while it waited for a master
