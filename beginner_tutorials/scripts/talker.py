#!/usr/bin/python3
"""Says hello ten times a second.

Publishes:  chatter (std_msgs/String)
Switch:     --unique   use the plain name "talker" instead of an anonymous one
"""

import argparse
import sys

import rosgraph
import rospy
from std_msgs.msg import String


def talk(anonymous):
    """Publish until the node is asked to stop."""
    # An anonymous node gets a random number behind its name, so that many can run side by side.
    # Names are unique on a ROS graph: a second node of the same name ends the first.
    rospy.init_node("talker", anonymous=anonymous)
    # Before every log line rospy asks the master for this parameter, until it is set; a node that
    # asks while a newer one of its name takes over would make the master end the newer one as well.
    if not rospy.has_param("/rosout_disable_topics_generation"):
        rospy.set_param("/rosout_disable_topics_generation", False)
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    rate = rospy.Rate(10, reset=True)  # [Hz]; reset: go on when a simulated clock starts anew
    while not rospy.is_shutdown():
        text = f"hello world {rospy.get_time():.2f}"
        rospy.loginfo(text)
        publisher.publish(text)
        rate.sleep()


def main():
    parser = argparse.ArgumentParser(description="Publishes a greeting on chatter, at 10 Hz.")
    parser.add_argument("--unique", action="store_true", help='be "talker", not anonymous')
    # rospy.myargv leaves out what ROS itself reads, such as chatter:=greetings.
    options = parser.parse_args(rospy.myargv()[1:])
    if not rosgraph.is_master_online():
        sys.exit(f"talker: no ROS master at {rosgraph.get_master_uri()}; start one with: roscore")
    try:
        talk(anonymous=not options.unique)
    except rospy.ROSInterruptException:
        pass  # the node was told to stop while it slept


if __name__ == "__main__":
    main()
