"""Mistakes in joy2twist and in the class, each a row: (exercise, what, edits, check, word or words)."""

from edits import CLASS, JOY2TWIST, J, chmod, latin1, move, put, remove, write

SHOW = 'rospy.loginfo(rospy.get_name() + ": axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)'
X, Z = "msg.linear.x = data.axes[1]", "msg.angular.z = data.axes[0]"
PUBLISH = "pub.publish(msg)"
PUB = "rospy.Publisher('/cmd_vel', Twist)"
SUB = 'rospy.Subscriber("/joy", Joy, callback)'


def node(what, old, new, check, word):
    """A row with one change in joy2twist.py."""
    return ("4.3", what, [put(JOY2TWIST, old, new)], check, word)


def cls(what, old, new, check, word):
    """A row with one change in the class."""
    return ("6.2", what, [put(CLASS, old, new)], check, word)


ROWS = [
    ("4.3", "no joy2twist.py", [remove(JOY2TWIST)], "C13", "create scripts/joy2twist.py"),
    ("4.3", "a file joy2twist that is no program", [move(JOY2TWIST, JOY2TWIST[:-3]), put(JOY2TWIST[:-3], "#!/usr/bin/env python", "")], "C13", "first line"),
    ("4.3", "Latin-1", [latin1(JOY2TWIST, "import rospy\n", "# von Jörg, für alle")], "C13", ("joy2twist.py:", "save the file as UTF-8")),
    ("4.3", "joy2twist.py without chmod beside a file joy2twist", [chmod(JOY2TWIST, 0o644), write(f"{J}/joy2twist", "notes")], "C13", "chmod +x scripts/joy2twist.py"),
    node("nothing displayed", SHOW, "pass", "C14", "not one value"),
    node("five of six values", SHOW, 'rospy.loginfo("[%.2f, %.2f, %.2f, %.2f, %.2f]" % data.axes)', "C14", "as many %.2f"),
    node("% data", "% data.axes", "% data", "C14", "data.axes"),
    node("only two axes displayed", SHOW, 'rospy.loginfo("%.2f %.2f" % data.axes[:2])', "C14", "six"),
    node("init_node missing", "    rospy.init_node('listener', anonymous=True)\n", "", "C14", "init_node"),
    node("spin missing", "    rospy.spin()\n", "", "C14", "rospy.spin()"),
    node("spin without ()", "rospy.spin()", "rospy.spin", "C14", "()"),
    node("listener without ()", "__main__':\n    listener()", "__main__':\n    listener", "C14", "listener()"),
    node("no Subscriber", f"    {SUB}\n", "", "C14", "Subscriber"),
    node("no callback given", "Joy, callback)", "Joy)", "C14", ("joy2twist.py:19", "no callback")),
    node("another topic to hear", '"/joy"', '"/joystick"', "C14", "/joystick"),
    node("capital in the topic", '"/joy"', '"/Joy"', "C14", "/Joy"),
    node("Twist for Joy", '"/joy", Joy,', '"/joy", Twist,', "C14", "wants Twist"),
    node("callback()", "Joy, callback)", "Joy, callback())", "C14", "without ()"),
    node("callback misspelt", "Joy, callback)", "Joy, calback)", "C14", "calback"),
    node("Joy not imported", "from sensor_msgs.msg import Joy\n", "", "C14", "import"),
    node("joy in lower case", "import Joy", "import joy", "C14", "capitals"),
    node("data misspelt", "def callback(data)", "def callback(date)", "C14", "data"),
    node("publishes on another topic", "'/cmd_vel'", "'/cmdvel'", "C15", "/cmdvel"),
    node("no Publisher", f"    pub = {PUB}\n", "", "C15", "Publisher"),
    node("another type published", PUB, "rospy.Publisher('/cmd_vel', Joy)", "C15", "Joy"),
    node("publishes on /joy", PUB, "rospy.Publisher('/joy', Joy)", "C15", "/joy"),
    node("axes swapped", f"{X}\n    {Z}", "msg.linear.x = data.axes[0]\n    msg.angular.z = data.axes[1]", "C16", "swapped"),
    node("turns the wrong way", Z, "msg.angular.z = -data.axes[0]", "C16", "sign"),
    node("drives backwards", X, "msg.linear.x = -data.axes[1]", "C16", "sign"),
    node("linear.z", "msg.linear.x", "msg.linear.z", "C16", "linear.z"),
    node("angular.x", "msg.angular.z", "msg.angular.x", "C16", "angular.x"),
    node("axis 2", "data.axes[1]", "data.axes[2]", "C16", "axes[2]"),
    node("axis 3 turns", "data.axes[0]", "data.axes[3]", "C16", "axes[3]"),
    node("linear.y too", X, f"{X}\n    msg.linear.y = data.axes[0]", "C16", "linear.y"),
    node("angular.z forgotten", f"    {Z}\n", "", "C16", "angular.z"),
    node("linear.x forgotten", f"    {X}\n", "", "C16", "linear.x"),
    node("axes(1)", "data.axes[1]", "data.axes(1)", "C16", "square brackets"),
    node("axes[6]", "data.axes[1]", "data.axes[6]", "C16", "6 axes"),
    node("axis for axes", "= data.axes[1]", "= data.axis[1]", "C16", "axis"),
    node("buttons for axes", "= data.axes[1]", "= data.buttons[1]", "C16", "linear.x"),
    node("global forgotten", "    global pub\n", "", "C16", "global"),
    node("Twist without ()", "msg = Twist()", "msg = Twist", "C16", "()"),
    node("publish forgotten", f"    {PUBLISH}\n", "", "C16", "publish"),
    node("publish(data)", PUBLISH, "pub.publish(data)", "C16", "publish the Twist"),
    node("a number for msg.linear", X, "msg.linear = data.axes[1]", "C16", ("joy2twist.py:11", "msg.linear has three parts")),
    node("publish(x, z)", PUBLISH, "pub.publish(data.axes[1], data.axes[0])", "C16", "publish"),
    node("Publish", PUBLISH, "pub.Publish(msg)", "C16", "Publish"),
    node("msq for msg", "msg = Twist()", "msq = Twist()", "C16", "ms"),
    node("published before it is set", f"    {X}\n    {Z}\n    {PUBLISH}", f"    {PUBLISH}\n    {X}\n    {Z}", "C16", "zero"),
    node("whole numbers", X, "msg.linear.x = int(data.axes[1])", "C16", "linear.x"),
    node("forwards only", X, "msg.linear.x = max(0, data.axes[1])", "C16", "linear.x is 0 wherever axes[1] is below 0"),
    node("abs", X, "msg.linear.x = abs(data.axes[1])", "C16", "sign"),
    node("sum", X, "msg.linear.x = data.axes[1] + data.axes[0]", "C16", "constant"),
    node("an offset", X, "msg.linear.x = data.axes[1] + 0.1", "C16", "released"),
    ("4.3", "one global Twist, published too early", [put(JOY2TWIST, "    msg = Twist()\n", ""), put(JOY2TWIST, "def callback(data):\n", "msg = Twist()\n\n\ndef callback(data):\n    pub.publish(msg)\n"), put(JOY2TWIST, f"{Z}\n    {PUBLISH}", Z)], "C16", "late"),
    node("sleep in the callback", PUBLISH, f"{PUBLISH}\n    rospy.sleep(0.1)", "C17", "sleep"),
    node("Rate in the callback", PUBLISH, f"{PUBLISH}\n    rospy.Rate(10).sleep()", "C17", "sleep"),
    node("only every second", PUBLISH, "callback.n = getattr(callback, 'n', 0) + 1\n    if callback.n % 2:\n        pub.publish(msg)", "C16", "Twists"),
    node("published twice", X, f"{X}\n    {PUBLISH}", "C16", ("joy2twist.py:14", "2 Twists for each Joy, and they differ", "at the end of the callback")),
    node("sleep before it publishes", "def callback(data):\n", "def callback(data):\n    rospy.sleep(0.5)\n", "C16", ("joy2twist.py:9", "the callback sleeps", "no sleep in the callback")),
    cls("def init", "def __init__(self)", "def init(self)", "C29", "`def init`"),
    cls("def _init_", "def __init__(self)", "def _init_(self)", "C29", "__init__"),
    cls("never made", "        NewJoy2Twist()\n", "        NewJoy2Twist\n", "C29", "never made"),
    cls("on_shutdown(self.shutdown())", "on_shutdown(self.shutdown)", "on_shutdown(self.shutdown())", "C29", "without ()"),
    cls("another name registered", "on_shutdown(self.shutdown)", "on_shutdown(self.stop)", "C29", "no stop"),
    cls("callback without self", "Joy, self.callback)", "Joy, callback)", "C29", "self.callback"),
    cls("self.callback()", "Joy, self.callback)", "Joy, self.callback())", "C29", "without ()"),
    cls("self forgotten in callback", "def callback(self, data)", "def callback(data)", "C30", "self"),
    cls("typo under the bare except", "rospy.Publisher", "rospy.Publsher", "C30", "Publsher"),
    cls("cmd_vel without self", "self.cmd_vel = ", "cmd_vel = ", "C30", "cmd_vel"),
    cls("cmd_vel for self.cmd_vel", "self.cmd_vel.publish(msg)", "cmd_vel.publish(msg)", "C30", "cmd_vel"),
    cls("spin missing", "        rospy.spin()\n", "", "C30", "spin"),
    cls("axes swapped in the class", "data.axes[1]\n        msg.angular.z = data.axes[0]", "data.axes[0]\n        msg.angular.z = data.axes[1]", "C30", "swapped"),
    cls("no on_shutdown", "        rospy.on_shutdown(self.shutdown)\n", "", "C31", "on_shutdown"),
    ("6.2", "the zero after spin", [put(CLASS, "        rospy.on_shutdown(self.shutdown)\n", ""), put(CLASS, "        rospy.spin()\n", "        rospy.spin()\n        self.shutdown()\n")], "C31", ("no zero", "on_shutdown")),
    cls("shutdown sends nothing", "        self.cmd_vel.publish(Twist())\n", "", "C31", "zero"),
    cls("shutdown without self", "def shutdown(self)", "def shutdown()", "C31", "self"),
    cls("shutdown publishes Twist", "self.cmd_vel.publish(Twist())", "self.cmd_vel.publish(Twist)", "C31", "Twist()"),
    cls("shutdown never ends", "rospy.sleep(1)", "import time; time.sleep(100)", "C31", "still runs"),
    cls("first it rests, then it stops", "self.cmd_vel.publish(Twist())\n        rospy.sleep(1)", "__import__('time').sleep(30)\n        self.cmd_vel.publish(Twist())", "C31", "no zero"),
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
    cls("the line of a callback without self", "def callback(self, data)", "def callback(data)", "C30", "new_joy2twist.py:16"),
    cls("the line of a shutdown without self", "def shutdown(self)", "def shutdown()", "C31", "new_joy2twist.py:23"),
    cls("Twst in shutdown", "self.cmd_vel.publish(Twist())", "self.cmd_vel.publish(Twst())", "C31", ("new_joy2twist.py:25", "Twist in line 5")),
    ("6.2", "chmod forgotten", [chmod(CLASS, 0o644)], "C29", "chmod"),
    ("6.2", "no class", [lambda src: (src / CLASS).unlink()], "C29", "no class"),
    node("v1 under two names", PUBLISH, "pub.publish(Twist())", "C16", "zero"),
]  # fmt: skip
