#!/usr/bin/python3
"""Prints each odometry message of the robot: time, speed, place.

The time is the monotonic clock's [s], which all hosts of the test share; then v [m/s], x, y [m].
"""

import time

import rospy
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node


def report(odometry):
    now, place = time.monotonic(), odometry.pose.pose.position
    print(now, odometry.twist.twist.linear.x, place.x, place.y, flush=True)


if __name__ == "__main__":
    init_node("observer")
    rospy.Subscriber("odom", Odometry, report, queue_size=100, tcp_nodelay=True)
    rospy.spin()
