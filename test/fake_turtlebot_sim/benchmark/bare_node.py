#!/usr/bin/python3
"""The minimum in rospy to publish the simulation's three messages at 50 Hz."""

import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

rospy.init_node("bare_node")
odom = rospy.Publisher("odom", Odometry, queue_size=10)
joint_states = rospy.Publisher("joint_states", JointState, queue_size=10)
tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
odometry, transform = Odometry(), TransformStamped()
odometry.header.frame_id = transform.header.frame_id = "odom"
odometry.child_frame_id = transform.child_frame_id = "base_footprint"
joints = JointState(
    name=["wheel_left_joint", "wheel_right_joint"], position=(0.0, 0.0), velocity=(0.0, 0.0)
)
transforms = TFMessage([transform])
rate = rospy.Rate(50)
while not rospy.is_shutdown():
    stamp = rospy.Time.now()
    odometry.header.stamp = transform.header.stamp = joints.header.stamp = stamp
    odom.publish(odometry)
    joint_states.publish(joints)
    tf.publish(transforms)
    rate.sleep()
