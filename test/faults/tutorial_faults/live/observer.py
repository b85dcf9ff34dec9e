"""An observer beside the robot, of its own: it writes down what wheels and commands do.

Lines: kind, time of the system clock [s], linear x, y and angular z. The kinds: `wheels` (/odom,
with its own stamp; when it came, under simulated time), `command` (cmd_vel of the base), `asked`
(the mux's input teleop; both without what a stranger says), `joy` (the axis forward, LB, RB),
`late` (a gap [s] in which this did not run).
"""

import sys
import threading
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from node_kit.careful_connections import sender_of
from tutorial_faults.live.beat import beat
from tutorial_testing.nodes import init_node

FORWARD, LB, RB = 1, 4, 5
STRANGER = "/stranger"  # begins the name of who says what nobody should


def main():
    """Observe until the standard input ends."""
    init_node("observer", disable_signals=True, disable_rosout=True)
    simulated = not rospy.rostime.is_wallclock()
    lock = threading.Lock()

    def tell(kind, at_s, *values):
        line = " ".join([kind, f"{at_s:.6f}", *map(repr, values)])
        with lock:
            print(line, flush=True)

    def wheels(odometry):
        at_s = time.time() if simulated else odometry.header.stamp.to_sec()
        twist = odometry.twist.twist
        tell("wheels", at_s, twist.linear.x, twist.linear.y, twist.angular.z)

    def command(twist, kind):
        if not sender_of(twist).startswith(STRANGER):
            tell(kind, time.time(), twist.linear.x, twist.linear.y, twist.angular.z)

    def joy(message):
        axes, buttons = message.axes, message.buttons
        if len(axes) > FORWARD and len(buttons) > RB:
            tell("joy", time.time(), axes[FORWARD], float(buttons[LB]), float(buttons[RB]))

    options = {"queue_size": 1000, "tcp_nodelay": True}
    rospy.Subscriber("odom", Odometry, wheels, **options)
    rospy.Subscriber("cmd_vel", Twist, command, "command", **options)
    rospy.Subscriber("cmd_vel_mux/input/teleop", Twist, command, "asked", **options)
    rospy.Subscriber("joy", Joy, joy, **options)
    beat(lambda at_s, gap_s: tell("late", at_s, gap_s, 0.0, 0.0))
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main()
