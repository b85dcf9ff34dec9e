#!/usr/bin/python3
"""The minimum in rospy: one Twist for each Joy, published in the callback's thread."""

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy


def callback(joy):
    twist = Twist()
    twist.linear.x = joy.axes[1]
    publisher.publish(twist)


rospy.init_node("bare_relay")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
publisher.impl.set_queue_size(None)  # no thread for each subscriber
rospy.Subscriber("joy", Joy, callback, tcp_nodelay=True)
rospy.spin()
