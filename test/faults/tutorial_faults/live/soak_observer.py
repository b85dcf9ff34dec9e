"""What the robot of launch_bag does in a soak: how often it speaks, and where each lap closes.

Lines: `rate SECONDS ODOMETRY COMMANDS` (how many came meanwhile) and `lap X Y YAW` [m, m, rad],
where it stands between two rounds of the recording.
"""

import math
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from tutorial_testing.nodes import init_node

# Longer than it stands between two moves of the recording, and less than between two rounds [s].
RESTS_S = 1.65
PERIOD_S = 10.0


class Laps:
    """Tells when a rest is that between two laps."""

    def __init__(self):
        """Begin with a robot that moves."""
        self._since_s = None

    def closes(self, moving, now):
        """Whether a lap closes with an odometry at a time [s]; once for each."""
        if moving:
            self._since_s = None
        elif self._since_s is None:
            self._since_s = now
        elif now - self._since_s > RESTS_S:
            self._since_s = math.inf
            return True
        return False


def main():
    """Observe until the standard input ends."""
    init_node("soak_observer", disable_signals=True, disable_rosout=True)
    laps, counts = Laps(), {"odometry": 0, "commands": 0, "since": time.monotonic()}

    def odometry(message):
        twist, pose = message.twist.twist, message.pose.pose
        counts["odometry"] += 1
        moving = bool(twist.linear.x or twist.angular.z)
        if laps.closes(moving, message.header.stamp.to_sec()):
            yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
            print("lap", repr(pose.position.x), repr(pose.position.y), repr(yaw), flush=True)
        now = time.monotonic()
        if now - counts["since"] >= PERIOD_S:
            told = now - counts["since"], counts["odometry"], counts["commands"]
            counts.update(odometry=0, commands=0, since=now)
            print("rate", *told, flush=True)

    def command(_twist):
        counts["commands"] += 1

    rospy.Subscriber("/odom", Odometry, odometry, queue_size=1000, tcp_nodelay=True)
    rospy.Subscriber("/cmd_vel", Twist, command, queue_size=1000, tcp_nodelay=True)
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main()
