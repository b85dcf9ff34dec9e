"""In ROS 2: publish odometry on /odom_of_ros2 at a rate, and count the messages on /odom.

many.py COUNT RATE: begins with the first message on /odom; prints how many arrived after the last.
"""

import sys
import time

import rclpy
from nav_msgs.msg import Odometry

QUIET_S = 2.0
count, rate = int(sys.argv[1]), float(sys.argv[2])
rclpy.init()
node = rclpy.create_node("many")
publisher = node.create_publisher(Odometry, "/odom_of_ros2", count)
came = []
hear = lambda odom: came.append(odom.pose.pose.position.x)  # noqa: E731
node.create_subscription(Odometry, "/odom", hear, count)
print("ready", flush=True)
while not came:
    rclpy.spin_once(node, timeout_sec=0.01)
message, begin_s, sent = Odometry(), time.monotonic(), 0
last_s, number = begin_s, 0
while sent < count or time.monotonic() - last_s < QUIET_S:
    if sent < count and time.monotonic() >= begin_s + sent / rate:
        message.pose.pose.position.x = float(sent)
        publisher.publish(message)
        sent += 1
    rclpy.spin_once(node, timeout_sec=0.0 if sent < count else 0.1)
    if len(came) > number:
        last_s, number = time.monotonic(), len(came)
order = f"in order {came == sorted(came)}"
print(f"sent {sent} in {rate:.0f} Hz, came {len(came)}, {order}", flush=True)
