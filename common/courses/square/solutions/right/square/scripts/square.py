#!/usr/bin/env python3
"""Drive a square of 1 m, by time."""

import math

import rospy
from geometry_msgs.msg import Twist

SPEED, TURN = 0.5, math.pi / 4  # [m/s], [rad/s]


def drive(publisher, v, w, seconds):
    twist = Twist()
    twist.linear.x, twist.angular.z = v, w
    rate, end = rospy.Rate(50), rospy.get_time() + seconds
    while rospy.get_time() < end and not rospy.is_shutdown():
        publisher.publish(twist)
        rate.sleep()


rospy.init_node("square")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while not cmd_vel.get_num_connections():
    rospy.sleep(0.05)
for _ in range(4):
    drive(cmd_vel, SPEED, 0.0, 1.0 / SPEED)
    drive(cmd_vel, 0.0, TURN, math.pi / 2 / TURN)
drive(cmd_vel, 0.0, 0.0, 1.0)
