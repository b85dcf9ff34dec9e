#!/usr/bin/python3
"""Says hello ten times a second on the topic chatter; with --unique under the plain name talker."""

import sys

import rospy
from std_msgs.msg import String


def talk():
    """Publish until the node is stopped."""
    # An anonymous node gets a number behind its name, so that many can run side by side. Names are
    # unique on a ROS graph: a second node of the same name ends the first.
    rospy.init_node("talker", anonymous="--unique" not in sys.argv)
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    rate = rospy.Rate(10, reset=True)  # [Hz]; reset: go on when a simulated clock restarts
    while not rospy.is_shutdown():
        text = f"hello world {rospy.get_time():.2f}"
        rospy.loginfo(text)
        publisher.publish(text)
        rate.sleep()


if __name__ == "__main__":
    try:
        talk()
    except rospy.ROSException:
        pass  # stopped while it slept, or while it waited for a master
