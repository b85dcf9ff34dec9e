#!/usr/bin/env python3
"""Follow turtle1 with another turtle."""

from math import atan2, hypot

import rospy
import tf2_ros
from geometry_msgs.msg import Twist
from turtlesim.srv import Spawn

rospy.init_node("turtle_tf2_listener")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
rospy.wait_for_service("spawn")
name = rospy.get_param("turtle", "turtle2")
rospy.ServiceProxy("spawn", Spawn)(4, 2, 0, name)
publisher = rospy.Publisher(f"{name}/cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    try:
        t = buffer.lookup_transform(name, "turtle1", rospy.Time()).transform
    except tf2_ros.TransformException:
        rate.sleep()
        continue
    twist = Twist()
    twist.angular.z = 4 * atan2(t.translation.y, t.translation.x)
    twist.linear.x = 0.5 * hypot(t.translation.x, t.translation.y)
    publisher.publish(twist)
    rate.sleep()
