#!/usr/bin/python3
"""Wanders: drives ahead while the way is free, otherwise turns; backs away from obstacles."""

import rospy
from geometry_msgs.msg import Twist
from kobuki_msgs.msg import BumperEvent
from sensor_msgs.msg import LaserScan

FREE, SPEED, TURN = 0.8, 0.3, 1.0  # [m], [m/s], [rad/s]
BACK_S, AWAY_S = 0.8, 1.5  # after a bump: backwards, then turning


class Wander:
    """Publishes a velocity for each scan."""

    def __init__(self):
        self.bumped_at, self.turn = rospy.Time(), TURN
        self.cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("mobile_base/events/bumper", BumperEvent, self.on_bumper)
        rospy.Subscriber("scan", LaserScan, self.on_scan, queue_size=1)

    def on_bumper(self, event):
        """Turn away from the side that was hit."""
        if event.state == BumperEvent.PRESSED:
            self.bumped_at = rospy.Time.now()
            self.turn = -TURN if event.bumper == BumperEvent.LEFT else TURN

    def on_scan(self, scan):
        """Back up after a bump; turn if something is ahead; otherwise, or at NaN, drive."""
        twist = Twist()
        since_bump = (rospy.Time.now() - self.bumped_at).to_sec()
        if since_bump < BACK_S:
            twist.linear.x = -SPEED / 2
        elif since_bump < AWAY_S or any(distance < FREE for distance in scan.ranges):
            twist.angular.z = self.turn
        else:
            twist.linear.x = SPEED
        self.cmd_vel.publish(twist)


if __name__ == "__main__":
    rospy.init_node("wander")
    Wander()
    rospy.spin()
