"""Mistakes in joy2twist and in the class, each a row: (exercise, what, edits, check, word or words)."""

from edits import CLASS, JOY2TWIST, J, chmod, copy, lines, move, put, remove, write

SHOW = 'rospy.loginfo(rospy.get_name() + ": axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)'
X, Z = "msg.linear.x = data.axes[1]", "msg.angular.z = data.axes[0]"
PUBLISH = "pub.publish(msg)"
PUB = "rospy.Publisher('/cmd_vel', Twist)"
SUB = 'rospy.Subscriber("/joy", Joy, callback)'


def tried(handler):
    """The change that puts the last line into a try, with a line in its `except Exception`."""
    block = f"    try:\n        listener()\n    except Exception as error:\n        {handler}\n"
    return "    listener()\n", block


def node(what, old, new, check, word):
    """A row with one change in joy2twist.py."""
    return ("4.3", what, [put(JOY2TWIST, old, new)], check, word)


def cls(what, old, new, check, word):
    """A row with one change in the class."""
    return ("6.2", what, [put(CLASS, old, new)], check, word)


ROWS = [
    ("4.3", "no joy2twist.py", [remove(JOY2TWIST)], "C13", "create scripts/joy2twist.py"),
    ("4.3", "a file joy2twist that is no program", [move(JOY2TWIST, JOY2TWIST[:-3]), put(JOY2TWIST[:-3], "#!/usr/bin/env python", "")], "C13", "first line"),
    ("4.3", "joy2twist.py without chmod beside a file joy2twist", [chmod(JOY2TWIST, 0o644), write(f"{J}/joy2twist", "notes")], "C13", ("chmod +x /", "src/joy2twist/scripts/joy2twist.py")),
    node("nothing displayed", SHOW, "pass", "C14", ("not one value", "data.axes in the callback")),
    node("five of six values", SHOW, 'rospy.loginfo("[%.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)', "C14", "as many %.2f"),
    node("% data", "% data.axes", "% data", "C14", "data.axes"),
    node("only two axes displayed", SHOW, 'rospy.loginfo("%.2f %.2f" % data.axes[:2])', "C14", "six"),
    node("one axis displayed", SHOW, 'rospy.loginfo("%.2f" % data.axes[1])', "C14", ("a line has 1 of the six", "all six")),
    node("one decimal", SHOW, 'rospy.loginfo("%.1f " * 6 % data.axes)', "C14", ("the six values have less than two decimals", "%.2f")),
    node("a line that fell out of the callback", f"    msg = Twist()\n    {X}\n    {Z}\n    {PUBLISH}\n", f"msg = Twist()\n{X}\n", "C14", ("joy2twist.py:11", "outside of callback: indent")),
    node("joy.msg", "sensor_msgs.msg", "joy.msg", "C14", ("joy2twist.py:4", "from sensor_msgs.msg import Joy")),
    node("a keyboard", "    rospy.spin()", "    import termios\n    termios.tcgetattr(0)", "C14", ("joy2twist.py:22", "termios.error", "no keyboard here")),
    ("4.3", "an import outside of the try", [put(JOY2TWIST, "import rospy\n", "import rospy\nimport wx\n"), put(JOY2TWIST, *tried("pass"))], "C14", ("joy2twist.py:4", "in: import wx\n")),
    ("4.3", "an except that prints the error", [put(JOY2TWIST, "import Joy", "import Joy as Stick"), put(JOY2TWIST, *tried("print(error)"))], "C14", ("joy2twist.py:19", "Joy, callback)\n")),
    ("4.3", "an except that prints another text", [put(JOY2TWIST, "import Joy", "import Joy as Stick"), put(JOY2TWIST, *tried("print('no luck')"))], "C14", ("joy2twist.py:19", "(`except Exception as error:` in line 27 shows another text)")),
    ("4.3", "another topic and type, and it ends", [put(JOY2TWIST, '"/joy", Joy', '"/stick", Twist'), put(JOY2TWIST, "    rospy.spin()\n", "")], "C14", ("it ended, exit code 0", "subscribes to /stick, Twist", "rospy.spin() is missing")),
    node("init_node missing", "    rospy.init_node('listener', anonymous=True)\n", "", "C14", "init_node"),
    node("spin missing", "    rospy.spin()\n", "", "C14", "rospy.spin()"),
    node("spin without ()", "rospy.spin()", "rospy.spin", "C14", "()"),
    node("listener without ()", "__main__':\n    listener()", "__main__':\n    listener", "C14", "listener()"),
    node("no Subscriber", f"    {SUB}\n", "", "C14", ("subscribes to nothing", "before rospy.spin()")),
    node("no callback given", "Joy, callback)", "Joy)", "C14", ("joy2twist.py:19", "no callback")),
    node("another topic to hear", '"/joy"', '"/joystick"', "C14", "/joystick"),
    node("capital in the topic", '"/joy"', '"/Joy"', "C14", ("joy2twist.py:19", "subscribes to /Joy", "in lower case")),
    node("Twist for Joy", '"/joy", Joy,', '"/joy", Twist,', "C14", ("joy2twist.py:19", "wants Twist", "Joy, callback)")),
    node("callback()", "Joy, callback)", "Joy, callback())", "C14", "without ()"),
    node("callback misspelt", "Joy, callback)", "Joy, calback)", "C14", "calback"),
    node("Joy not imported", "from sensor_msgs.msg import Joy\n", "", "C14", "import"),
    node("joy in lower case", "import Joy", "import joy", "C14", "capitals"),
    node("data misspelt", "def callback(data)", "def callback(date)", "C14", "data"),
    node("publishes on another topic", "'/cmd_vel'", "'/cmdvel'", "C15", "/cmdvel"),
    node("no Publisher", f"    pub = {PUB}\n", "", "C15", "Publisher"),
    node("another type published", PUB, "rospy.Publisher('/cmd_vel', Joy)", "C15", ("joy2twist.py:20", "/cmd_vel carries sensor_msgs/Joy")),
    node("publishes on /joy", PUB, "rospy.Publisher('/joy', Joy)", "C15", "/joy"),
    node("turns the wrong way", Z, "msg.angular.z = -data.axes[0]", "C16", "sign"),
    node("linear.z", "msg.linear.x", "msg.linear.z", "C16", "linear.z"),
    node("axis 2", "data.axes[1]", "data.axes[2]", "C16", "axes[2]"),
    node("linear.y too", X, f"{X}\n    msg.linear.y = data.axes[0]", "C16", "linear.y"),
    node("angular.z forgotten", f"    {Z}\n", "", "C16", "angular.z"),
    node("linear.x forgotten", f"    {X}\n", "", "C16", "linear.x"),
    node("axes(1)", "data.axes[1]", "data.axes(1)", "C16", "square brackets"),
    node("axes[6]", "data.axes[1]", "data.axes[6]", "C16", "6 axes"),
    node("axis for axes", "= data.axes[1]", "= data.axis[1]", "C16", "axis"),
    node("global forgotten", "    global pub\n", "", "C16", "global"),
    node("Twist without ()", "msg = Twist()", "msg = Twist", "C16", "()"),
    node("publish forgotten", f"    {PUBLISH}\n", "", "C16", "publish"),
    node("a number for msg.linear", X, "msg.linear = data.axes[1]", "C16", ("joy2twist.py:11", "msg.linear has three parts")),
    node("publish(x, z)", PUBLISH, "pub.publish(data.axes[1], data.axes[0])", "C16", "publish"),
    node("Publish", PUBLISH, "pub.Publish(msg)", "C16", "Publish"),
    node("published before it is set", f"    {X}\n    {Z}\n    {PUBLISH}", f"    {PUBLISH}\n    {X}\n    {Z}", "C16", "zero"),
    node("whole numbers", X, "msg.linear.x = int(data.axes[1])", "C16", "linear.x has whole numbers only"),
    node("never at rest", X, "msg.linear.x = max(0.2, data.axes[1])", "C16", "linear.x is 0.20 at rest"),
    node("a square", X, "msg.linear.x = data.axes[1] ** 2", "C16", "lost the sign"),
    node("steers as a car does", Z, "msg.angular.z = data.axes[0] if data.axes[1] >= 0 else -data.axes[0]", "C16", "changes sign when axes[1] is negative"),
    node("a zero after each Twist", PUBLISH, f"{PUBLISH}\n    pub.publish(Twist())", "C16", ("joy2twist.py:14", "two Twists for one Joy, and the second is zero")),
    node("axis for axes under an except", f"    {X}\n    {Z}\n    {PUBLISH}", f"    try:\n        msg.linear.x = data.axis[1]\n        {Z}\n        {PUBLISH}\n    except:\n        pass", "C16", ("joy2twist.py:12", "axis", "hidden by `except:` in line 15")),
    node("forwards only", X, "msg.linear.x = max(0, data.axes[1])", "C16", "linear.x is 0 wherever axes[1] is below 0"),
    node("abs", X, "msg.linear.x = abs(data.axes[1])", "C16", "sign"),
    node("sum", X, "msg.linear.x = data.axes[1] + data.axes[0]", "C16", "linear.x = 1.00 * axes[1] + 1.00 * axes[0]: two axes in one"),
    node("difference", Z, "msg.angular.z = (data.axes[5] - data.axes[2]) / 2", "C16", "angular.z = -0.50 * axes[2] + 0.50 * axes[5]: two axes in one"),
    node("an offset", X, "msg.linear.x = data.axes[1] + 0.1", "C16", "released"),
    node("sleep in the callback", PUBLISH, f"{PUBLISH}\n    rospy.sleep(0.1)", "C17", "sleep"),
    node("published twice", X, f"{X}\n    {PUBLISH}", "C16", ("joy2twist.py:14", "2 Twists for each Joy, and they differ", "at the end of the callback")),
    node("sleep before it publishes", "def callback(data):\n", "def callback(data):\n    rospy.sleep(0.5)\n", "C16", ("joy2twist.py:9", "the callback sleeps", "no sleep in the callback")),
    node("a loop without end in place of spin", "rospy.spin()", "while True:\n        pass", "C34", ("joy2twist.py:21", "had to be killed", "rospy.spin()")),
    node("a loop that sleeps in place of spin", "rospy.spin()", "import time\n    while True:\n        time.sleep(1)", "C34", ("joy2twist.py:22", "rospy.spin()")),
    cls("def _init_", "def __init__(self)", "def _init_(self)", "C29", ("`def _init_`", "__init__")),
    cls("never made", "        NewJoy2Twist()\n", "        NewJoy2Twist\n", "C29", "never made"),
    cls("on_shutdown(self.shutdown())", "on_shutdown(self.shutdown)", "on_shutdown(self.shutdown())", "C29", "without ()"),
    cls("another name registered", "on_shutdown(self.shutdown)", "on_shutdown(self.stop)", "C29", "no stop"),
    cls("shutdown within the method above", "    def shutdown(self):\n        ", "        def shutdown(self):\n            pass\n        ", "C29", ("new_joy2twist.py:11", "`def shutdown` in line 23 is no method", "like `def __init__`")),
    ("6.2", "an old copy of the same name", [copy(CLASS, f"{J}/old/new_joy2twist.py")], "C29", "several: old/new_joy2twist.py, scripts/new_joy2"),
    cls("callback without self", "Joy, self.callback)", "Joy, callback)", "C29", "self.callback"),
    cls("self.callback()", "Joy, self.callback)", "Joy, self.callback())", "C29", "without ()"),
    cls("typo under the bare except", "rospy.Publisher", "rospy.Publsher", "C30", "Publsher"),
    cls("a line that fell out of its method", "        self.cmd_vel.publish(msg)", "    self.cmd_vel.publish(msg)", "C30", ("new_joy2twist.py:21", "outside of callback")),
    cls("cmd_vel without self", "self.cmd_vel = ", "cmd_vel = ", "C30", "cmd_vel"),
    cls("cmd_vel for self.cmd_vel", "self.cmd_vel.publish(msg)", "cmd_vel.publish(msg)", "C30", "cmd_vel"),
    cls("spin missing", "        rospy.spin()\n", "", "C30", "spin"),
    cls("axes swapped in the class", "data.axes[1]\n        msg.angular.z = data.axes[0]", "data.axes[0]\n        msg.angular.z = data.axes[1]", "C30", "swapped"),
    cls("no on_shutdown", "        rospy.on_shutdown(self.shutdown)\n", "", "C31", "on_shutdown"),
    ("6.2", "the zero after spin", [put(CLASS, "        rospy.on_shutdown(self.shutdown)\n", ""), put(CLASS, "        rospy.spin()\n", "        rospy.spin()\n        self.shutdown()\n")], "C31", ("no zero", "on_shutdown")),
    cls("shutdown sends nothing", "        self.cmd_vel.publish(Twist())\n", "", "C31", "zero"),
    cls("shutdown publishes Twist", "self.cmd_vel.publish(Twist())", "self.cmd_vel.publish(Twist)", "C31", "Twist()"),
    cls("shutdown never ends", "rospy.sleep(1)", "import time; time.sleep(100)", "C31", "still runs"),
    cls("first it rests, then it stops", "self.cmd_vel.publish(Twist())\n        rospy.sleep(1)", "__import__('time').sleep(30)\n        self.cmd_vel.publish(Twist())", "C31", ("new_joy2twist.py:25", "no zero", "first the zero")),
    cls("a zero on Ctrl-C alone", "rospy.on_shutdown(self.shutdown)", "import os, signal\n        signal.signal(signal.SIGINT, lambda *_: (self.shutdown(), os._exit(0)))", "C31", "after rosnode kill: no zero"),
    cls("ends not on Ctrl-C", "        rospy.spin()", "        import signal\n        signal.signal(signal.SIGINT, signal.SIG_IGN)\n        rospy.spin()", "C31", "after Ctrl-C: no zero"),
    cls("takes the arguments of a launch file for its own", "rospy.Publisher('/cmd_vel'", "rospy.Publisher([*__import__('sys').argv, '/cmd_vel'][1]", "C31", "rospy.myargv"),
    cls("at its end it starts the older version", "Twist())\n        rospy.sleep(1)", "Twist())\n        import rosnode, subprocess\n        subprocess.Popen([__file__.replace('new_joy', 'joy')])\n        while 'listener' not in str(rosnode.get_node_names()):\n            rospy.sleep(0.05)\n        rospy.sleep(1)", "C31", "still drives"),
    cls("ends where there is no joystick yet", "        rospy.Subscriber(", "        dict(rospy.get_published_topics())['/joy']\n        rospy.Subscriber(", "C33", "nobody publishes on /joy"),
    ("6.2", "ends without a joystick and a word", [put(CLASS, "        rospy.Subscriber(", "        '/joy' in dict(rospy.get_published_topics()) or exit()\n        rospy.Subscriber("), put(CLASS, "except:", "except rospy.ROSInterruptException:")], "C33", "and it ends"),
    node("a gap in the topic", "'/cmd_vel'", "'/cmd vel'", "C13", ("joy2twist.py:20", "has a space", "'/cmd_vel'")),
    node("a gap in the node's name", "'listener'", "'joy listener'", "C13", ("joy2twist.py:18", "has a space", "'joy_listener'")),
    node("gaps in __main__", "'__main__'", "' main '", "C13", ("joy2twist.py:24", "if __name__ == '__main__':")),
    node("msq of the PDF", "    msg = Twist()", "    msq = Twist()", "C16", ("joy2twist.py:11", "msq in line 10")),
    cls("self forgotten in callback", "def callback(self, data)", "def callback(data)", "C30", ("new_joy2twist.py:16", "a method has self first")),
    cls("shutdown without self", "def shutdown(self)", "def shutdown()", "C31", ("new_joy2twist.py:23", "a method has self first")),
    cls("Twst in shutdown", "self.cmd_vel.publish(Twist())", "self.cmd_vel.publish(Twst())", "C31", ("new_joy2twist.py:25", "Twist in line 5")),
    ("6.2", "no class", [lambda src: (src / CLASS).unlink()], "C29", "no class"),
    ("4.3", "an own rospy.py beside it", [write(f"{J}/scripts/rospy.py", "import time\n")], "C14", ("scripts/rospy.py", "hides", "rename")),
    ("4.3", "an own geometry_msgs.py beside it", [write(f"{J}/scripts/geometry_msgs.py", "class Twist: pass\n")], "C14", ("scripts/geometry_msgs.py", "hides", "rename")),
    ("4.3", "joy2twist.py hides the library of its own package", [put(JOY2TWIST, "import rospy\n", "import rospy\nfrom joy2twist.tools import zone\n"), write(f"{J}/src/joy2twist/__init__.py", ""), write(f"{J}/src/joy2twist/tools.py", "zone = abs\n")], "C14", ("scripts/joy2twist.py:4", "hides", "another name")),
    node("a number published", PUBLISH, "pub.publish(5)", "C16", ("joy2twist.py:13", "publish the Twist")),
    node("both from buttons", f"{X}\n    {Z}", "msg.linear.x = data.buttons[1]\n    msg.angular.z = data.buttons[0]", "C16", ("joy2twist.py:11", "data.axes, not data.buttons")),
    node("a loop of zeros beside the callback", "    rospy.spin()", "    rate = rospy.Rate(10)\n    while not rospy.is_shutdown():\n        pub.publish(Twist())\n        rate.sleep()", "C16", ("joy2twist.py:23", "zeros come between")),
    ("4.3", "imports lost, beside an old copy", [copy(JOY2TWIST, f"{J}/scripts/joy2twist_copy.py"), lines(JOY2TWIST, 4, 5, 10, 11, 12, 13, 20)], "C14", ("joy2twist.py:", "Joy")),
]  # fmt: skip
