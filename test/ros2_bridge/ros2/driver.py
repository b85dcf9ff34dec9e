"""In ROS 2: publish a velocity on /cmd_vel, ten times a second. DURABILITY RELIABILITY SPEED"""

import sys

import rclpy
from geometry_msgs.msg import Twist
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

durability, reliability, speed = sys.argv[1:]
rclpy.init()
node = rclpy.create_node("driver")
profile = QoSProfile(
    depth=1,
    durability=DurabilityPolicy[durability.upper()],
    reliability=ReliabilityPolicy[reliability.upper()],
)
publisher, twist = node.create_publisher(Twist, "/cmd_vel", profile), Twist()
twist.linear.x = float(speed)
node.create_timer(0.1, lambda: publisher.publish(twist))
try:
    rclpy.spin(node)
finally:
    node.destroy_node()  # so that other nodes notice at once
