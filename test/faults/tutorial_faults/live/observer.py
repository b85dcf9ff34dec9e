"""An observer beside the robot: it prints what wheels and commands do.

Lines: kind, time of the system clock [s], linear x, y and angular z. The kinds: `wheels` (/odom,
with its own stamp), `command` (cmd_vel of the base) and `asked` (the mux's input teleop), both
without what a stranger publishes, `late` (a gap [s] in which this program did not run).
"""

import sys
import threading
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from node_kit.careful_connections import sender_of
from tutorial_faults.live.helpers import beat
from tutorial_testing.nodes import init_node

STRANGER = "/stranger"  # begins the name of the programs that send what they should not


def main():
    """Observe until the standard input ends."""
    init_node("observer", disable_signals=True, disable_rosout=True)
    lock = threading.Lock()

    def report(kind, at_s, twist):
        values = twist.linear.x, twist.linear.y, twist.angular.z
        with lock:
            print(kind, f"{at_s:.6f}", *map(repr, values), flush=True)

    def wheels(odometry):
        report("wheels", odometry.header.stamp.to_sec(), odometry.twist.twist)

    def command(twist, kind):
        if not sender_of(twist).startswith(STRANGER):
            report(kind, time.time(), twist)

    def late(at_s, gap_s):
        gap = Twist()
        gap.linear.x = gap_s
        report("late", at_s, gap)

    options = {"queue_size": 1000, "tcp_nodelay": True}
    rospy.Subscriber("odom", Odometry, wheels, **options)
    rospy.Subscriber("cmd_vel", Twist, command, "command", **options)
    rospy.Subscriber("cmd_vel_mux/input/teleop", Twist, command, "asked", **options)
    beat(late)
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main()
