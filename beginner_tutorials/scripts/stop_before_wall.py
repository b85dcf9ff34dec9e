#!/usr/bin/python3
"""Drives ahead with ~speed [m/s], and stops 0.4 m before a wall."""

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

# From the camera, which scans, to the front of the robot [m]: 0.087 m behind the middle of a
# disc with a radius of 0.178 m.
TO_FRONT = 0.087 + 0.178
GAP = 0.4  # [m]


class StopBeforeWall:
    """Publishes a velocity for each scan."""

    def __init__(self):
        self.speed = rospy.get_param("~speed", 0.3)
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("scan", LaserScan, self.on_scan, queue_size=1)

    def on_scan(self, scan):
        """Drive while nothing is near: -inf means too near; inf and NaN mean no measurement."""
        twist = Twist()
        if not any(distance < TO_FRONT + GAP for distance in scan.ranges):
            twist.linear.x = self.speed
        self.cmd_vel.publish(twist)


if __name__ == "__main__":
    rospy.init_node("stop_before_wall")
    StopBeforeWall()
    rospy.spin()
