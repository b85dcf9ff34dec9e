#!/usr/bin/python3
"""Repeats what it hears.

Subscribes: chatter (std_msgs/String)
Switch:     --unique   use the plain name "listener" instead of an anonymous one
"""

import argparse
import sys

import rosgraph
import rospy
from std_msgs.msg import String


def callback(message):
    """Called by rospy, in a thread of its own, for every message on chatter."""
    rospy.loginfo("%s: I heard %s", rospy.get_name(), message.data)


def main():
    parser = argparse.ArgumentParser(description="Displays every message on chatter.")
    parser.add_argument("--unique", action="store_true", help='be "listener", not anonymous')
    options = parser.parse_args(rospy.myargv()[1:])
    if not rosgraph.is_master_online():
        sys.exit(f"listener: no ROS master at {rosgraph.get_master_uri()}; start one with: roscore")
    rospy.init_node("listener", anonymous=not options.unique)
    # Before every log line rospy asks the master for this parameter, until it is set; a node that
    # asks while a newer one of its name takes over would make the master end the newer one as well.
    if not rospy.has_param("/rosout_disable_topics_generation"):
        rospy.set_param("/rosout_disable_topics_generation", False)
    rospy.Subscriber("chatter", String, callback)
    rospy.spin()  # the callback does the work; this only keeps the program alive


if __name__ == "__main__":
    main()
