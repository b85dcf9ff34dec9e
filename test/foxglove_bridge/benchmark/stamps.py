#!/usr/bin/python3
"""Publishes the time, 50 times a second."""

import time

import rospy
from geometry_msgs.msg import PointStamped

PERIOD_S = 0.02
rospy.init_node("stamps")
publisher = rospy.Publisher("stamps", PointStamped, queue_size=10)
message, due_s = PointStamped(), time.monotonic()
while not rospy.is_shutdown():
    message.header.stamp = rospy.Time.from_sec(time.time())
    publisher.publish(message)
    due_s += PERIOD_S
    time.sleep(max(0.0, due_s - time.monotonic()))
