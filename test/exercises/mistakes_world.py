"""The seventh lesson: right solutions beside ours, and mistakes. Rows as elsewhere."""

from pathlib import Path

from edits import B, put, remove, write

OURS = Path(__file__).resolve().parents[2] / "beginner_tutorials" / "scripts"
NAMES = ("bumper.py", "stop_before_wall.py", "wander.py")
BUMPER, STOP, WANDER = (f"{B}/scripts/{name}" for name in NAMES)
SOLVED = [write(f"{B}/scripts/{name}", (OURS / name).read_text()) for name in NAMES]


def row(what, path, old, new, check, word):
    """A row with one change in our solution."""
    return ("7", what, [*SOLVED, put(path, old, new)], check, word)


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
ROWS = [
    ("7", "no bumper.py", [*SOLVED, remove(BUMPER)], "C35", "scripts/bumper.py"),
    row("another topic", BUMPER, "mobile_base/events/bumper", "events/bumper", "C35", "it subscribes to /events/bumper"),
    row("nothing displayed", BUMPER, SHOWN, "pass", "C35", "left bumper on the screen"),
    row("always the same bumper", BUMPER, "SIDES[event.bumper]", "'left'", "C35", "the center bumper"),
    row("a field that there is not", BUMPER, "SIDES[event.bumper]", "event.sensor", "C35", "bumper.py:"),
    row("no spin", BUMPER, "    rospy.spin()\n", "", "C35", "until Ctrl-C"),
    row("one line for all", BUMPER, SHOWN, 'rospy.loginfo("left, center or right: %s", change)', "C35", "for all: left"),
    row("it never stops", STOP, "not any(one < TO_FRONT + GAP for one in scan.ranges)", "True", "C36", "into the wall"),
    row("from the camera, not the front", STOP, "TO_FRONT = 0.087 + 0.178", "TO_FRONT = 0.0", "C36", "0.087 m"),
    row("it stops too early", STOP, "GAP = 0.4", "GAP = 0.7", "C36", "m before the wall"),
    row("a speed of its own", STOP, 'rospy.get_param("~speed", 0.3)', "0.3", "C36", "get_param"),
    row("no zero near the wall", STOP, "        self.cmd_vel.publish(twist)", "            self.cmd_vel.publish(twist)", "C36", "no zero came"),
    row("another topic of the velocity", STOP, '"cmd_vel"', '"cmd_vel_mux/input/teleop"', "C36", "it publishes on /cmd_vel_mux/input/teleop"),
    row("it does not move", STOP, '"scan"', '"/camera/scan"', "C36", "for each LaserScan on scan"),
    row("a scan that is no list", STOP, "scan.ranges)", "scan.ranges.values())", "C36", "stop_before_wall.py:"),
    row("it ignores the bumper and the laser", WANDER, "if since_bump < BACK_S:", "if True:\n            twist.linear.x = SPEED\n        elif since_bump < BACK_S:", "C37", "it pushed"),
    row("it turns on the spot", WANDER, "any(one < FREE for one in scan.ranges)", "True", "C37", "turn until it is"),
    row("it stands before a wall", WANDER, "twist.angular.z = self.turn", "pass", "C37", "in a place"),
    row("it circles blindly", WANDER, "if since_bump < BACK_S:", "if True:\n            twist.linear.x, twist.angular.z = 0.3, 0.4\n        elif since_bump < BACK_S:", "C37", "it pushed"),
    row("it stands after a while", WANDER, "if since_bump < BACK_S:", "self.began = getattr(self, 'began', rospy.get_time())\n        if rospy.get_time() - self.began > 25.0:\n            pass\n        elif since_bump < BACK_S:", "C37", "it did not move for"),
    row("it ends", WANDER, "    rospy.spin()\n", "", "C37", "rospy.spin()"),
]  # fmt: skip
RIGHT = [
    ("lesson 7, NaN and all else that is not measured left out", [*SOLVED, put(STOP, "scan.ranges)", "scan.ranges if scan.range_min <= one <= scan.range_max)"), put(WANDER, "any(one < FREE for one in scan.ranges)", "min([one for one in scan.ranges if one == one] or [9.0]) < FREE")], ["7"]),
    ("lesson 7, a callback that is attached late", [*SOLVED, put(BUMPER, "import rospy\n", LATE)], ["7"]),
    ("lesson 7, each event as it comes", [*SOLVED, put(BUMPER, SHOWN, "rospy.loginfo(event)")], ["7"]),
    ("lesson 7, it ends once it stands", [*SOLVED, put(STOP, "        self.cmd_vel.publish(twist)", "        self.cmd_vel.publish(twist)\n        if not twist.linear.x:\n            rospy.signal_shutdown('at the wall')")], ["7"]),
    ("lesson 7, slower near the wall", [*SOLVED, put(STOP, "twist.linear.x = self.speed", "twist.linear.x = min(self.speed, 2 * (min(scan.ranges) - TO_FRONT - GAP) + 0.02)")], ["7"]),
]  # fmt: skip
