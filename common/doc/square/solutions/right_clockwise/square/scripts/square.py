#!/usr/bin/env python3
"""Drive a square of 1 m, by odometry, to the right."""

from math import atan2, hypot, pi

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

CORNERS = [(1, 0), (1, -1), (0, -1), (0, 0)]


class Square:
    """Drives to one corner after the other."""

    def __init__(self):
        self.left = list(CORNERS)
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("odom", Odometry, self.on_odom, queue_size=1)

    def on_odom(self, odom):
        twist = Twist()
        if self.left:
            here, turn = odom.pose.pose.position, odom.pose.pose.orientation
            dx, dy = self.left[0][0] - here.x, self.left[0][1] - here.y
            off = (atan2(dy, dx) - 2 * atan2(turn.z, turn.w) + pi) % (2 * pi) - pi
            twist.angular.z = max(-1.0, min(1.0, 2 * off))
            twist.linear.x = 0.4 if abs(off) < 0.1 else 0.0
            if hypot(dx, dy) < 0.05:
                self.left.pop(0)
        self.cmd_vel.publish(twist)


rospy.init_node("square")
Square()
rospy.spin()
