#!/usr/bin/env python3
"""Drive turtle1 to a goal."""

from math import atan2, hypot, pi

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

pose = Pose()


def keep(message):
    pose.x, pose.y, pose.theta = message.x, message.y, message.theta


x, y, tolerance = (float(input(f"{word}: ")) for word in ("x", "y", "tolerance"))
rospy.init_node("gotogoal")
publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=10)
rospy.Subscriber("turtle1/pose", Pose, keep)
rospy.wait_for_message("turtle1/pose", Pose)
rate = rospy.Rate(10)
twist = Twist()
while hypot(x - pose.x, y - pose.y) >= tolerance and not rospy.is_shutdown():
    turn = atan2(y - pose.y, x - pose.x) - pose.theta
    twist.linear.x = 1.5 * hypot(x - pose.x, y - pose.y)
    twist.angular.z = 6 * ((turn + pi) % (2 * pi) - pi)
    publisher.publish(twist)
    rate.sleep()
publisher.publish(Twist())
rospy.spin()
