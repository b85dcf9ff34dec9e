"""Programs for 4.3 from a grammar: with a mistake that hardly shows, and right in other ways."""

import re
import textwrap

from edits import JOY2TWIST, X, Z, write

HEAD = """#!/usr/bin/env python3
import queue
import threading
import time
from types import SimpleNamespace

import rospy
from geometry_msgs.msg import Twist, Vector3
from sensor_msgs.msg import Joy

"""
SHOW = 'rospy.loginfo("%s", " ".join("%.2f" % axis for axis in data.axes))'
# `my.` has what is kept from one Joy to the next.
FUNCTIONS = """my = SimpleNamespace()


def callback(data):
    {show}
    {answer}


def main():
    rospy.init_node("joy2twist")
    my.pub = rospy.Publisher("/cmd_vel", Twist, queue_size=10)
    {keep}
    rospy.Subscriber("/joy", Joy, callback)
    {spin}


if __name__ == "__main__":
    main()
"""
CLASS = """class Converter:
    def __init__(self):
        my.pub = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        {keep}
        my.sub = rospy.Subscriber("/joy", Joy, my.heard, queue_size=10)

    def heard(self, data):
        {answer}
        {show}

    def run(self):
        {spin}


if __name__ == "__main__":
    rospy.init_node("joy2twist")
    Converter().run()
"""
CLOSURE = """def main():
    rospy.init_node("converter", anonymous=True)
    my = SimpleNamespace(pub=rospy.Publisher("cmd_vel", Twist, queue_size=100, tcp_nodelay=True))
    {keep}

    def heard(data):
        {answer}

    rospy.Subscriber("joy", Joy, lambda data: (heard(data), {show}))
    {spin}


main()
"""
QUEUE = """my = SimpleNamespace()
inbox = queue.Queue()


def convert(data):
    {show}
    {answer}


rospy.init_node("joy2twist")
my.pub = rospy.Publisher("/cmd_vel", Twist, queue_size=10)
{keep}
rospy.Subscriber("/joy", Joy, inbox.put)
while not rospy.is_shutdown():
    try:
        convert(inbox.get(timeout=0.1))
    except queue.Empty:
        pass
"""
FRAMES = {"functions": FUNCTIONS, "class": CLASS, "closure": CLOSURE, "queue": QUEUE}
PUBLISH = "my.pub.publish(msg)"
PLAIN = f"msg = Twist()\n{X}\n{Z}\n"
HELD = "data.buttons[4]"
TWICE = "my.pub.publish(my.msg)"
SET = "my.msg.linear.x = data.axes[1]\nmy.msg.angular.z = data.axes[0]\n"
KEPT = "my.msg = Twist()"


def program(frame, answer, keep="", spin=""):
    """answer: what is done for a Joy; keep: what is made before; spin: the rest."""
    parts = {"show": SHOW, "answer": answer, "keep": keep or "pass", "spin": spin or "rospy.spin()"}
    fill = lambda hole: textwrap.indent(parts[hole[2]].rstrip(), hole[1])  # noqa: E731
    text = re.sub(r"( *)\{(\w+)\}", fill, HEAD + FRAMES[frame])
    return text.replace("my.", "self.") if frame == "class" else text


def values(x, z="data.axes[0]", before=""):
    return f"{before}msg = Twist()\nmsg.linear.x = {x}\nmsg.angular.z = {z}\n{PUBLISH}"


def only_if(condition, answer=PLAIN + PUBLISH):
    return answer.replace(PUBLISH, f"if {condition}:\n    {PUBLISH}")


LOOP = "rate = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n    my.pub.publish(my.msg)\n    rate.sleep()"
TIMER = "my.timer = rospy.Timer(rospy.Duration({}), lambda event: my.pub.publish(my.msg))"
THREAD = (
    "def beat():\n    while not rospy.is_shutdown():\n        my.pub.publish(my.msg)\n"
    "        time.sleep(0.02)\nthreading.Thread(target=beat, daemon=True).start()"
)
SETS = PLAIN + "my.msg = msg"
# (what, answer, keep, spin, words of the diagnosis)
MISTAKES = [
    # gates
    ("gate: an axis moves", only_if("data.axes[0] or data.axes[1]"), "", "", "at rest"),
    ("gate: axis 1 moves", only_if("data.axes[1] != 0"), "", "", "at rest"),
    ("gate: beyond a dead zone", only_if("max(map(abs, data.axes[:2])) > 0.1"), "", "", "at rest"),
    ("gate: any value at all", only_if("any(data.axes)"), "", "", "at rest"),
    ("gate: LB held", only_if(HELD), "", "", "LB released"),
    ("gate: return without LB", f"if not {HELD}:\n    return\n{PLAIN}{PUBLISH}", "", "", "LB released"),
    ("gate: a new message", only_if("msg != my.last", PLAIN + PUBLISH + "\nmy.last = msg"), "my.last = None", "", "same Joy again"),
    ("gate: a large change", only_if("abs(msg.linear.x - my.x) + abs(msg.angular.z - my.z) > 0.02", PLAIN + PUBLISH + "\nmy.x, my.z = msg.linear.x, msg.angular.z"), "my.x = my.z = 9.0", "", "same Joy again"),
    ("gate: every third", only_if("my.n % 3 == 0", f"my.n += 1\n{PLAIN}{PUBLISH}"), "my.n = 0", "", "Twists for 20 Joys"),
    ("gate: every fifth", only_if("my.n % 5 == 0", f"my.n += 1\n{PLAIN}{PUBLISH}"), "my.n = 0", "", "seen:     4 Twists for 20 Joys"),
    ("gate: one zero without LB", f"if not {HELD}:\n    if my.held:\n        my.pub.publish(Twist())\n    my.held = False\n    return\nmy.held = True\n{PLAIN}{PUBLISH}", "my.held = False", "", "only one zero after LB is released"),
    ("gate: it turns only while it drives", f"msg = Twist()\nif data.axes[1]:\n    {X}\n    {Z}\n{PUBLISH}", "", "", "alone is moved"),
    # memories
    ("memory: axis 1 at zero changes nothing", f"if data.axes[1]:\n    my.msg.linear.x = data.axes[1]\nmy.msg.angular.z = data.axes[0]\n{TWICE}", KEPT, "", "linear.x stays"),
    ("memory: axis 0 in its dead zone changes nothing", f"my.msg.linear.x = data.axes[1]\nif abs(data.axes[0]) > 0.05:\n    my.msg.angular.z = data.axes[0]\n{TWICE}", KEPT, "", "angular.z stays"),
    ("memory: without LB the last one again", f"if {HELD}:\n    my.msg = Twist()\n    {SET.strip().replace(chr(10), chr(10) + '    ')}\n{TWICE}", KEPT, "", "LB released"),
    ("memory: forwards, backwards, and nothing else", f"if data.axes[1] > 0:\n    my.msg.linear.x = data.axes[1]\nelif data.axes[1] < 0:\n    my.msg.linear.x = data.axes[1]\nmy.msg.angular.z = data.axes[0]\n{TWICE}", KEPT, "", "linear.x stays"),
    ("memory: the fastest so far", f"my.x = max(my.x, abs(data.axes[1]))\n{values('my.x if data.axes[1] > 0 else -my.x')}", "my.x = 0.0", "", "linear.x"),
    ("memory: half of the one before", f"my.x = 0.5 * my.x + 0.5 * data.axes[1]\n{values('my.x')}", "my.x = 0.0", "", "linear.x depends on earlier Joys"),
    ("memory: a small value is skipped", f"if abs(data.axes[1]) > 0.1 or data.axes[1] == 0:\n    my.x = data.axes[1]\n{values('my.x')}", "my.x = 0.0", "", "linear.x stays 0.70 when axes[1] is 0.06: the robot drives on"),
    ("memory: a small change is skipped", f"if abs(data.axes[1] - my.x) > 0.1:\n    my.x = data.axes[1]\n{values('my.x')}", "my.x = 0.0", "", "depends on earlier Joys"),
    # buttons
    ("button: a cruise control", f"if data.buttons[0]:\n    my.x = data.axes[1]\n{values('my.x or data.axes[1]')}", "my.x = 0.0", "", "the robot drives on"),
    ("button: stops by silence", f"if data.buttons[1]:\n    return\n{PLAIN}{PUBLISH}", "", "", "buttons[1] pressed"),
    ("button: faster with each Joy", f"if data.buttons[5]:\n    my.k *= 1.1\n{values('my.k * data.axes[1]')}", "my.k = 0.5", "", "once buttons[5] was pressed"),
    # accumulators
    ("accumulator: +=", f"my.msg.linear.x += data.axes[1]\nmy.msg.angular.z = data.axes[0]\n{TWICE}", KEPT, "", "linear.x"),
    ("accumulator: += on both axes", f"my.msg.linear.x += data.axes[1]\nmy.msg.angular.z += data.axes[0]\n{TWICE}", KEPT, "", "depends on earlier Joys: it grows while the stick is held"),
    ("accumulator: a tenth of it", f"my.msg.linear.x += 0.1 * data.axes[1]\nmy.msg.angular.z = data.axes[0]\n{TWICE}", KEPT, "", "linear.x"),
    ("accumulator: a heading", f"my.z += data.axes[0]\n{values('data.axes[1]', 'my.z')}", "my.z = 0.0", "", "angular.z"),
    # clocks
    ("clock: a loop of 10 Hz", SETS, KEPT, LOOP, "a clock of its own"),
    ("clock: a Timer of 20 Hz", SETS, f"{KEPT}\n{TIMER.format(0.05)}", "", "a clock of its own"),
    ("clock: a Timer of 4 Hz", SETS, f"{KEPT}\n{TIMER.format(0.25)}", "", "a clock of its own"),
    ("clock: a thread of 50 Hz", SETS, f"{KEPT}\n{THREAD}", "", "a clock of its own"),
    ("clock: ten a second at most", only_if("time.time() - my.s > 0.1", f"{PLAIN}{PUBLISH}\n    my.s = time.time()"), "my.s = 0.0", "", "Twists for"),
    # rounding
    ("rounding: one digit", values("round(data.axes[1], 1)"), "", "", "linear.x has steps"),
    ("rounding: tenths cut off", values("data.axes[1]", "int(10 * data.axes[0]) / 10.0"), "", "", "angular.z has steps"),
    ("rounding: two gears", values("0.6 if data.axes[1] > 0.5 else 0.3 if data.axes[1] > 0.1 else data.axes[1]"), "", "", "linear.x"),
    # order
    ("order: published, then set", f"{TWICE}\n{SET}", KEPT, "", "one message late"),
    ("order: one of them is set too late", f"my.msg.linear.x = data.axes[1]\n{TWICE}\nmy.msg.angular.z = data.axes[0]", KEPT, "", "angular.z follows the Joy before"),
    ("order: the axes swapped", values("data.axes[0]", "data.axes[1]"), "", "", "swapped"),
]  # fmt: skip
WATCHDOG = (
    "my.when = time.time()\ndef watch(event):\n    if time.time() - my.when > 0.5:\n"
    "        my.pub.publish(Twist())\nmy.timer = rospy.Timer(rospy.Duration(0.1), watch)"
)
ZONE = "def zone(value):\n    return value if abs(value) > 0.1 else 0.0\nmy.zone = zone"
# (what, answer, keep)
STYLES = [
    ("plain", PLAIN + PUBLISH, ""),
    ("one message, set again", SET + TWICE, KEPT),
    ("keywords", "my.pub.publish(Twist(linear=Vector3(x=data.axes[1]), angular=Vector3(z=data.axes[0])))", ""),
    ("unpacked", f"left, forwards, *rest = data.axes\n{values('forwards', 'left')}", ""),
    ("a factor and a parameter", values("my.top * data.axes[1]", "1.5 * data.axes[0]"), "my.top = rospy.get_param('~top', 0.7)"),
    ("a dead zone", values("my.zone(data.axes[1])", "my.zone(data.axes[0])"), ZONE),
    ("a dead zone by if and else", f"msg = Twist()\nif data.axes[1] > 0.2 or data.axes[1] < -0.2:\n    {X}\nelse:\n    msg.linear.x = 0\n{Z}\n{PUBLISH}", ""),
    ("a limit", values("max(-0.5, min(0.5, data.axes[1]))", "max(-0.4, min(0.4, data.axes[0]))"), ""),
    ("without LB zero", f"{PLAIN}if not {HELD}:\n    msg = Twist()\n{PUBLISH}", ""),
    ("without LB zero, and return", f"if not {HELD}:\n    my.pub.publish(Twist())\n    return\n{PLAIN}{PUBLISH}", ""),
    ("LB times the axes", values(f"{HELD} * data.axes[1]", f"{HELD} * data.axes[0]"), ""),
    ("faster while RB is held", values("(2.0 if data.buttons[5] else 1.0) * data.axes[1]"), ""),
    ("button 1 stops", f"msg = Twist()\nif not data.buttons[1]:\n    {X}\n    {Z}\n{PUBLISH}", ""),
    ("a curve", values("data.axes[1] ** 3", "data.axes[0] * abs(data.axes[0])"), ""),
    ("backwards at half the speed", values("data.axes[1] * (1.0 if data.axes[1] > 0 else 0.5)"), ""),
    ("a watchdog publishes zero", f"my.when = time.time()\n{PLAIN}{PUBLISH}", WATCHDOG),
    ("counted, kept, and not used", f"my.n += 1\n{PLAIN}my.last = msg\n{PUBLISH}", "my.n = 0"),
]  # fmt: skip

WRONG = [
    ("4.3", f"{what}, in {frame}", [write(JOY2TWIST, program(frame, answer, keep, spin))], "C16", words)
    for what, answer, keep, spin, words in MISTAKES
    for frame in ("functions", "class")
]  # fmt: skip
RIGHT = [
    (f"{what}, in {frame}", [write(JOY2TWIST, program(frame, answer, keep))], ["4.3"])
    for what, answer, keep in STYLES
    for frame in FRAMES
]
