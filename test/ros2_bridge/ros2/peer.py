"""In ROS 2: repeat on /reply the messages of /note, and print a picture's size."""

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Image
from std_msgs.msg import String

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

rclpy.init()
node = rclpy.create_node("peer")
reply = node.create_publisher(String, "/reply", LATCHED)
node.create_subscription(String, "/note", reply.publish, LATCHED)
show = lambda image: print("picture", len(image.data), flush=True)  # noqa: E731
node.create_subscription(Image, "/picture", show, LATCHED)
rclpy.spin(node)
