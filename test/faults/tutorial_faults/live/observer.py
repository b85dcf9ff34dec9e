"""An observer beside the robot: it prints what wheels and commands do.

Lines: kind, time of the system clock [s], linear x, y and angular z. The kinds: `wheels` (/odom,
with its own stamp), `command` (cmd_vel of the base) and `asked` (the mux's input teleop), both
without what a stranger publishes, `late` (a gap [s] in which this program did not run), `bumpers`
and `drops` (how many bumpers are pressed, and wheels dropped). A line that it reads is a heading
[rad], into which it turns the robot, lifted to the middle of its world.
"""

import math
import sys
import threading
import time

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from kobuki_msgs.msg import BumperEvent, WheelDropEvent
from nav_msgs.msg import Odometry

from node_kit.careful_connections import sender_of
from tutorial_faults.live.helpers import beat
from tutorial_testing.nodes import init_node

STRANGER = "/stranger"  # begins the name of the programs that send what they should not


def main():
    """Observe until the standard input ends."""
    init_node("observer", disable_signals=True, disable_rosout=True)
    lock = threading.Lock()

    def report(kind, at_s, x, y=0.0, z=0.0):
        with lock:
            print(kind, f"{at_s:.6f}", *map(repr, (x, y, z)), flush=True)

    def report_twist(kind, at_s, twist):
        report(kind, at_s, twist.linear.x, twist.linear.y, twist.angular.z)

    def wheels(odometry):
        report_twist("wheels", odometry.header.stamp.to_sec(), odometry.twist.twist)

    def command(twist, kind):
        if not sender_of(twist).startswith(STRANGER):
            report_twist(kind, time.time(), twist)

    active = {"bumpers": set(), "drops": set()}

    def event(message, about):
        kind, field = about
        change = set.add if message.state else set.discard
        change(active[kind], getattr(message, field))
        report(kind, time.time(), float(len(active[kind])))

    options = {"queue_size": 1000, "tcp_nodelay": True}
    rospy.Subscriber("odom", Odometry, wheels, **options)
    rospy.Subscriber("cmd_vel", Twist, command, "command", **options)
    rospy.Subscriber("cmd_vel_mux/input/teleop", Twist, command, "asked", **options)
    for name, message, *about in (
        ("bumper", BumperEvent, "bumpers", "bumper"),
        ("wheel_drop", WheelDropEvent, "drops", "wheel"),
    ):
        rospy.Subscriber(f"mobile_base/events/{name}", message, event, about, **options)
    beat(lambda at_s, gap_s: report("late", at_s, gap_s))
    hand = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=1)
    with lock:
        print("ready", flush=True)
    for heading_rad in map(float, sys.stdin):
        for kind, sensors in active.items():
            sensors.clear()  # a base that was killed released none
            report(kind, time.time(), 0.0)
        pose = PoseWithCovarianceStamped()
        pose.header.frame_id = "map"
        orientation = pose.pose.pose.orientation
        orientation.z, orientation.w = math.sin(heading_rad / 2), math.cos(heading_rad / 2)
        hand.publish(pose)


if __name__ == "__main__":
    main()
