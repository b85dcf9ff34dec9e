"""Programs for 4.3 from a grammar: with subtle mistakes, and right in unusual ways."""

import re
import textwrap

from edits import write
from rows import mistake, right
from solution import JOY2TWIST, X, Z

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
# `my.` holds what is kept from one Joy to the next.
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
SET = f"my.{X}\nmy.{Z}\n"
KEPT = "my.msg = Twist()"


def program(frame, answer, keep="", spin=""):
    """Return a program. answer: its reaction to a Joy; keep: its preparation; spin: the rest."""
    parts = {"show": SHOW, "answer": answer, "keep": keep or "pass", "spin": spin or "rospy.spin()"}

    def fill(hole):
        return textwrap.indent(parts[hole[2]].rstrip(), hole[1])

    text = re.sub(r"( *)\{(\w+)\}", fill, HEAD + FRAMES[frame])
    return text.replace("my.", "self.") if frame == "class" else text


def values(x, z="data.axes[0]", before=""):
    return f"{before}msg = Twist()\nmsg.linear.x = {x}\nmsg.angular.z = {z}\n{PUBLISH}"


def only_if(condition, answer=PLAIN + PUBLISH):
    return answer.replace(PUBLISH, f"if {condition}:\n    {PUBLISH}")


LOOP = (
    "rate = rospy.Rate(10)\nwhile not rospy.is_shutdown():\n"
    "    my.pub.publish(my.msg)\n    rate.sleep()"
)
TIMER = "my.timer = rospy.Timer(rospy.Duration({}), lambda event: my.pub.publish(my.msg))"
THREAD = (
    "def beat():\n    while not rospy.is_shutdown():\n        my.pub.publish(my.msg)\n"
    "        time.sleep(0.02)\nthreading.Thread(target=beat, daemon=True).start()"
)
SETS = PLAIN + "my.msg = msg"
SET_X = "my.x = data.axes[1]"
COUNTED = f"my.n += 1\n{PLAIN}{PUBLISH}"
CLOCK = "a clock of its own"


def wrong(what, answer, words, keep="", spin=""):
    """Return a mistake in each of two frames."""
    return [
        mistake(
            f"{what}, in {frame}", [write(JOY2TWIST, program(frame, answer, keep, spin))],
            "C16", words,
        )
        for frame in ("functions", "class")
    ]  # fmt: skip


def gate(what, condition, words, answer=PLAIN + PUBLISH, keep=""):
    """Return mistakes that publish only under a condition."""
    return wrong(f"gate: {what}", only_if(condition, answer), words, keep)


def kept(what, change, words):
    """Return mistakes that change one message again and again."""
    return wrong(what, f"{change}\n{TWICE}", words, KEPT)


def kept_x(what, change, words, x="my.x"):
    """Return mistakes whose linear.x comes from what is kept."""
    return wrong(what, f"{change}\n{values(x)}", words, "my.x = 0.0")


MISTAKES = [
    gate("an axis moves", "data.axes[0] or data.axes[1]", "at rest"),
    gate("axis 1 moves", "data.axes[1] != 0", "at rest"),
    gate("beyond a dead zone", "max(map(abs, data.axes[:2])) > 0.1", "at rest"),
    gate("any value at all", "any(data.axes)", "at rest"),
    gate("LB held", HELD, "LB released"),
    wrong("gate: return without LB", f"if not {HELD}:\n    return\n{PLAIN}{PUBLISH}",
        "LB released"),
    gate("a new message", "msg != my.last", "same Joy again", f"{PLAIN}{PUBLISH}\nmy.last = msg",
        "my.last = None"),
    gate("a large change", "abs(msg.linear.x - my.x) + abs(msg.angular.z - my.z) > 0.02",
        "same Joy again", f"{PLAIN}{PUBLISH}\nmy.x, my.z = msg.linear.x, msg.angular.z",
        "my.x = my.z = 9.0"),
    gate("every third", "my.n % 3 == 0", "Twists for 20 Joys", COUNTED, "my.n = 0"),
    gate("every fifth", "my.n % 5 == 0", "seen:     4 Twists for 20 Joys", COUNTED, "my.n = 0"),
    wrong("gate: one zero without LB",
        f"if not {HELD}:\n    if my.held:\n        my.pub.publish(Twist())\n    my.held = False\n"
        f"    return\nmy.held = True\n{PLAIN}{PUBLISH}", "only one zero after LB is released",
        "my.held = False"),
    wrong("gate: it turns only while it drives",
        f"msg = Twist()\nif data.axes[1]:\n    {X}\n    {Z}\n{PUBLISH}", "alone is moved"),
    kept("memory: axis 1 at zero changes nothing", f"if data.axes[1]:\n    my.{X}\nmy.{Z}",
        "linear.x stays"),
    kept("memory: axis 0 in its dead zone changes nothing",
        f"my.{X}\nif abs(data.axes[0]) > 0.05:\n    my.{Z}", "angular.z stays"),
    kept("memory: without LB the last one again",
        f"if {HELD}:\n    my.msg = Twist()\n    my.{X}\n    my.{Z}", "LB released"),
    kept("memory: forwards, backwards, and nothing else",
        f"if data.axes[1] > 0:\n    my.{X}\nelif data.axes[1] < 0:\n    my.{X}\nmy.{Z}",
        "linear.x stays"),
    kept_x("memory: the fastest so far", "my.x = max(my.x, abs(data.axes[1]))", "linear.x",
        "my.x if data.axes[1] > 0 else -my.x"),
    kept_x("memory: half of the one before", "my.x = 0.5 * my.x + 0.5 * data.axes[1]",
        "linear.x depends on earlier Joys"),
    kept_x("memory: a small value is skipped",
        f"if abs(data.axes[1]) > 0.1 or data.axes[1] == 0:\n    {SET_X}",
        "linear.x stays 0.70 when axes[1] is 0.06: the robot drives on"),
    kept_x("memory: a small change is skipped", f"if abs(data.axes[1] - my.x) > 0.1:\n    {SET_X}",
        "depends on earlier Joys"),
    kept_x("button: a cruise control", f"if data.buttons[0]:\n    {SET_X}", "the robot drives on",
        "my.x or data.axes[1]"),
    wrong("button: stops by silence", f"if data.buttons[1]:\n    return\n{PLAIN}{PUBLISH}",
        "buttons[1] pressed"),
    wrong("button: faster with each Joy",
        f"if data.buttons[5]:\n    my.k *= 1.1\n{values('my.k * data.axes[1]')}",
        "once buttons[5] was pressed", "my.k = 0.5"),
    kept("accumulator: +=", f"my.msg.linear.x += data.axes[1]\nmy.{Z}", "linear.x"),
    kept("accumulator: += on both axes",
        "my.msg.linear.x += data.axes[1]\nmy.msg.angular.z += data.axes[0]",
        "depends on earlier Joys: it grows while the stick is held"),
    kept("accumulator: a tenth of it", f"my.msg.linear.x += 0.1 * data.axes[1]\nmy.{Z}",
        "linear.x"),
    wrong("accumulator: a heading", f"my.z += data.axes[0]\n{values('data.axes[1]', 'my.z')}",
        "angular.z", "my.z = 0.0"),
    wrong("clock: a loop of 10 Hz", SETS, CLOCK, KEPT, LOOP),
    wrong("clock: a Timer of 20 Hz", SETS, CLOCK, f"{KEPT}\n{TIMER.format(0.05)}"),
    wrong("clock: a Timer of 4 Hz", SETS, CLOCK, f"{KEPT}\n{TIMER.format(0.25)}"),
    wrong("clock: a thread of 50 Hz", SETS, CLOCK, f"{KEPT}\n{THREAD}"),
    wrong("clock: ten a second at most", only_if("time.time() - my.s > 0.1",
        f"{PLAIN}{PUBLISH}\n    my.s = time.time()"), "Twists for", "my.s = 0.0"),
    wrong("rounding: one digit", values("round(data.axes[1], 1)"), "linear.x has steps"),
    wrong("rounding: tenths cut off", values("data.axes[1]", "int(10 * data.axes[0]) / 10.0"),
        "angular.z has steps"),
    wrong("rounding: two gears",
        values("0.6 if data.axes[1] > 0.5 else 0.3 if data.axes[1] > 0.1 else data.axes[1]"),
        "linear.x"),
    wrong("order: published, then set", f"{TWICE}\n{SET}", "one message late", KEPT),
    wrong("order: one of them is set too late", f"my.{X}\n{TWICE}\nmy.{Z}",
        "angular.z follows the previous Joy", KEPT),
    wrong("order: the axes swapped", values("data.axes[0]", "data.axes[1]"), "swapped"),
]  # fmt: skip
WATCHDOG = (
    "my.when = time.time()\ndef watch(event):\n    if time.time() - my.when > 0.5:\n"
    "        my.pub.publish(Twist())\nmy.timer = rospy.Timer(rospy.Duration(0.1), watch)"
)
ZONE = "def zone(value):\n    return value if abs(value) > 0.1 else 0.0\nmy.zone = zone"


def style(what, answer, keep=""):
    """Return a right solution in each frame."""
    return [
        right(f"{what}, in {frame}", "4.3", write(JOY2TWIST, program(frame, answer, keep)))
        for frame in FRAMES
    ]


STYLES = [
    style("plain", PLAIN + PUBLISH),
    style("one message, set again", SET + TWICE, KEPT),
    style("keywords",
        "my.pub.publish(Twist(linear=Vector3(x=data.axes[1]), angular=Vector3(z=data.axes[0])))"),
    style("unpacked", f"left, forwards, *rest = data.axes\n{values('forwards', 'left')}"),
    style("a factor and a parameter", values("my.top * data.axes[1]", "1.5 * data.axes[0]"),
        "my.top = rospy.get_param('~top', 0.7)"),
    style("a dead zone", values("my.zone(data.axes[1])", "my.zone(data.axes[0])"), ZONE),
    style("a dead zone by if and else",
        f"msg = Twist()\nif data.axes[1] > 0.2 or data.axes[1] < -0.2:\n    {X}\nelse:\n"
        f"    msg.linear.x = 0\n{Z}\n{PUBLISH}"),
    style("a limit", values("max(-0.5, min(0.5, data.axes[1]))",
        "max(-0.4, min(0.4, data.axes[0]))")),
    style("without LB zero", f"{PLAIN}if not {HELD}:\n    msg = Twist()\n{PUBLISH}"),
    style("without LB zero, and return",
        f"if not {HELD}:\n    my.pub.publish(Twist())\n    return\n{PLAIN}{PUBLISH}"),
    style("LB times the axes", values(f"{HELD} * data.axes[1]", f"{HELD} * data.axes[0]")),
    style("faster while RB is held", values("(2.0 if data.buttons[5] else 1.0) * data.axes[1]")),
    style("button 1 stops", f"msg = Twist()\nif not data.buttons[1]:\n    {X}\n    {Z}\n{PUBLISH}"),
    style("a curve", values("data.axes[1] ** 3", "data.axes[0] * abs(data.axes[0])")),
    style("backwards at half the speed",
        values("data.axes[1] * (1.0 if data.axes[1] > 0 else 0.5)")),
    style("a watchdog publishes zero", f"my.when = time.time()\n{PLAIN}{PUBLISH}", WATCHDOG),
    style("counted, kept, and not used", f"my.n += 1\n{PLAIN}my.last = msg\n{PUBLISH}", "my.n = 0"),
]  # fmt: skip
WRONG = [row for rows in MISTAKES for row in rows]
RIGHT = [row for rows in STYLES for row in rows]
