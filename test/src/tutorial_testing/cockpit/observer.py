#!/usr/bin/python3
"""Writes down each odometry message: its stamp [s], v [m/s], w [rad/s], x, y [m]."""

import rospy
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node


def tell(odometry):
    twist, place = odometry.twist.twist, odometry.pose.pose.position
    stamp = odometry.header.stamp.to_sec()
    print(f"{stamp:.6f}", twist.linear.x, twist.angular.z, place.x, place.y, flush=True)


if __name__ == "__main__":
    init_node("observer", disable_rosout=True)
    rospy.Subscriber("odom", Odometry, tell, queue_size=100, tcp_nodelay=True)
    rospy.spin()
