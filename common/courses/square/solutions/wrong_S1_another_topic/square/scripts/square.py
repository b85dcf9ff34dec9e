#!/usr/bin/env python3
"""Publish where no robot subscribes."""

import rospy
from geometry_msgs.msg import Twist

rospy.init_node("square")
velocity = rospy.Publisher("velocity", Twist, queue_size=1)
while not rospy.is_shutdown():
    velocity.publish(Twist())
    rospy.sleep(0.1)
