"""The seventh lesson: right solutions beside ours, and mistakes."""

from edits import put, remove, write
from rows import mistake, mistake_in, right
from solution import B

from tutorial_testing.processes import REPOSITORY

OURS = REPOSITORY / "beginner_tutorials" / "scripts"
NAMES = ("bumper.py", "stop_before_wall.py", "wander.py")
BUMPER, STOP, WANDER = (f"{B}/scripts/{name}" for name in NAMES)
SOLVED = [write(f"{B}/scripts/{name}", (OURS / name).read_text()) for name in NAMES]

# What a busy machine may do: rospy is connected long before it attaches the callback.
LATE = """import rospy
import time
from rospy.topics import _SubscriberImpl
attach = _SubscriberImpl.add_callback

def attach_late(*arguments):
    until_s = time.monotonic() + 0.2
    while time.monotonic() < until_s:
        pass
    attach(*arguments)

_SubscriberImpl.add_callback = attach_late
"""
SHOWN = 'rospy.loginfo("%s bumper %s", SIDES[event.bumper], change)'
bumper = mistake_in(BUMPER, "C35", *SOLVED)
stop = mistake_in(STOP, "C36", *SOLVED)
wander = mistake_in(WANDER, "C37", *SOLVED)
ROWS = [
    bumper("another topic", "mobile_base/events/bumper", "events/bumper",
        "it subscribes to /events/bumper"),
    bumper("nothing displayed", SHOWN, "pass", "left bumper on the screen"),
    bumper("always the same bumper", "SIDES[event.bumper]", "'left'", "the center bumper"),
    bumper("a field that there is not", "SIDES[event.bumper]", "event.sensor", "bumper.py:"),
    bumper("no spin", "    rospy.spin()\n", "", "until Ctrl-C"),
    bumper("one line for all", SHOWN, 'rospy.loginfo("left, center or right: %s", change)',
        "for all: left"),
    mistake("no bumper.py", [*SOLVED, remove(BUMPER)], "C35", "scripts/bumper.py"),
    stop("it never stops", "not any(distance < TO_FRONT + GAP for distance in scan.ranges)", "True",
        "into the wall"),
    stop("from the camera, not the front", "TO_FRONT = 0.087 + 0.178", "TO_FRONT = 0.0", "0.087 m"),
    stop("it stops too early", "GAP = 0.4", "GAP = 0.7", "m before the wall"),
    stop("a speed of its own", 'rospy.get_param("~speed", 0.3)', "0.3", "get_param"),
    stop("no zero near the wall", "        self.cmd_vel.publish(twist)", "    &", "no zero came"),
    stop("another topic of the velocity", '"cmd_vel"', '"cmd_vel_mux/input/teleop"',
        "it publishes on /cmd_vel_mux/input/teleop"),
    stop("it does not move", '"scan"', '"/camera/scan"', "for each LaserScan on scan"),
    stop("a scan that is no list", "scan.ranges)", "scan.ranges.values())", "stop_before_wall.py:"),
    wander("it ignores the bumper and the laser", "if since_bump < BACK_S:",
        "if True:\n            twist.linear.x = SPEED\n        el&", "it pushed"),
    wander("it turns on the spot", "any(distance < FREE for distance in scan.ranges)", "True",
        "turn until it is"),
    wander("it stands before a wall", "twist.angular.z = self.turn", "pass", "in a place"),
    wander("it circles blindly", "if since_bump < BACK_S:",
        "if True:\n            twist.linear.x, twist.angular.z = 0.3, 0.4\n        el&",
        "it pushed"),
    wander("it stands after a while", "if since_bump < BACK_S:",
        "self.began = getattr(self, 'began', rospy.get_time())\n"
        "        if rospy.get_time() - self.began > 25.0:\n            pass\n        el&",
        "it did not move for"),
    wander("it ends", "    rospy.spin()\n", "", "rospy.spin()"),
]  # fmt: skip
RIGHT = [
    right("lesson 7, NaN and all else that is not measured left out", "7", *SOLVED, put(STOP,
        "scan.ranges)", "scan.ranges if scan.range_min <= distance <= scan.range_max)"), put(WANDER,
        "any(distance < FREE for distance in scan.ranges)",
        "min([one for one in scan.ranges if one == one] or [9.0]) < FREE")),
    right("lesson 7, a callback that is attached late", "7", *SOLVED,
        put(BUMPER, "import rospy\n", LATE)),
    right("lesson 7, each event as it comes", "7", *SOLVED,
        put(BUMPER, SHOWN, "rospy.loginfo(event)")),
    right("lesson 7, it ends once it stands", "7", *SOLVED, put(STOP,
        "        self.cmd_vel.publish(twist)",
        "&\n        if not twist.linear.x:\n            rospy.signal_shutdown('at the wall')")),
    right("lesson 7, slower near the wall", "7", *SOLVED, put(STOP, "twist.linear.x = self.speed",
        "twist.linear.x = min(self.speed, 2 * (min(scan.ranges) - TO_FRONT - GAP) + 0.02)")),
]  # fmt: skip
