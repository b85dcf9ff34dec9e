#!/usr/bin/env python3
"""Broadcast the pose of a turtle."""

from math import cos, sin

import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from turtlesim.msg import Pose


def broadcast(pose, name):
    t = TransformStamped()
    t.header.stamp = rospy.Time.now()
    t.header.frame_id = "world"
    t.child_frame_id = name
    t.transform.translation.x = pose.x
    t.transform.translation.y = pose.y
    t.transform.rotation.z = sin(pose.theta / 2)
    t.transform.rotation.w = cos(pose.theta / 2)
    broadcaster.sendTransform(t)


rospy.init_node("turtle_tf2_broadcaster")
broadcaster = tf2_ros.TransformBroadcaster()
turtle = rospy.get_param("~turtle")
rospy.Subscriber(f"/{turtle}/pose", Pose, broadcast, turtle)
rospy.spin()
