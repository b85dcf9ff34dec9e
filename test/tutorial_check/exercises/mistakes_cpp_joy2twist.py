"""Mistakes in joy2twist in C++, and in launch files that start it."""

import shutil

from edits import copy, put
from rows import mistake, mistake_in
from solution import JOY_CMAKE, B, J
from solution_cpp import CLASS, JOY2TWIST, PUB, PUBLISH, SHOW, SUB, X, Z

TURTLEBOT, STICK = f"{J}/launch/joy2twist_turtlebot.launch", f"{J}/launch/launch_joy_node.launch"
GLOBAL = "ros::Publisher cmd_vel;\n"
CALLBACK = "void drive(const sensor_msgs::Joy::ConstPtr& joy)\n{\n"
SPIN = "  ros::spin();\n"
BODY = f"  {X}\n  {Z}\n  {PUBLISH}\n"
MAKE = "  NewJoy2Twist node;\n  robot = &node;\n"
TO_TELEOP = 'from="/cmd_vel" to="/cmd_vel_mux/input/teleop"'
OF_CLASS = (
    "\nadd_executable(new_joy2twist src/new_joy2twist.cpp)\n"
    "target_link_libraries(new_joy2twist ${catkin_LIBRARIES})\n"
)


def alone(src):
    """Leave joy2twist only, which is built in a quarter of the time."""
    shutil.rmtree(src / B)
    put(JOY_CMAKE, OF_CLASS, "")(src)


node14, node15, node16, node17, node34 = (
    mistake_in(JOY2TWIST, check, alone) for check in ("C14", "C15", "C16", "C17", "C34")
)
class14 = mistake_in(JOY2TWIST, "C14", alone, copy(CLASS, JOY2TWIST))
KEPT = [  # the Twist is global, so that it keeps its values
    put(JOY2TWIST, "  geometry_msgs::Twist twist;\n", ""),
    put(JOY2TWIST, GLOBAL, "&geometry_msgs::Twist twist;\n"),
]
FIELDS = "src/joy2twist.cpp:13"


def loop(condition, line):
    """Return a loop in place of ros::spin()."""
    body = f"    {line}\n    rate.sleep();\n"
    return f"  ros::Rate rate(10);\n  while ({condition})\n  {{\n{body}  }}\n"


def several(what, edits, check, *words):
    """Return a mistake of several edits."""
    return mistake(what, [alone, *edits], check, *words)


ROWS = [
    node14("nothing displayed in C++", SHOW, "", "not one value", "msg->axes", "ROS_INFO"),
    node14("one decimal in C++", "%.2f", "%.1f", "the six values have fewer than two decimals"),
    node14("another topic to hear in C++", '"/joy"', '"/joystick"', "joy2twist.cpp:23",
        "/joystick", 'n.subscribe("/joy", 10, callback)'),
    several("a Twist in the callback", [put(JOY2TWIST, SHOW, ""),
        put(JOY2TWIST, "sensor_msgs::Joy::", "geometry_msgs::Twist::"),
        put(JOY2TWIST, "axes[1]", "linear.x"), put(JOY2TWIST, "axes[0]", "angular.z")], "C14",
        "joy2twist.cpp:21", "wants Twist", "const sensor_msgs::Joy::ConstPtr"),
    node14("no spin", SPIN, "", "ended, exit code 0", "ros::spin()"),
    node14("spin before subscribe", f"  {SUB}\n{SPIN}", f"{SPIN}  {SUB}\n", "joy2twist.cpp:24",
        "ros::spin() comes before it"),
    node14("a loop without spinOnce", SPIN, loop("ros::ok()", ""), "joy2twist.cpp:25",
        "never called", "spinOnce"),
    node14("a Subscriber that is not kept", SUB, 'node.subscribe("/joy", 10, drive);',
        "joy2twist.cpp:23", "is not kept"),
    several("a Subscriber of a function", [put(JOY2TWIST, f"  {SUB}\n", "  listen(node);\n"),
        put(JOY2TWIST, "int main", f"void listen(ros::NodeHandle node)\n{{\n  {SUB}\n}}\n\n&")],
        "C14", "joy2twist.cpp:20", "stick ends with listen()", "member of the class"),
    class14("a member hidden in the constructor", "joy_ = node_", "ros::Subscriber &",
        "joy2twist.cpp:13", "joy_ ends with NewJoy2Twist()", "without a type"),
    class14("an object that is a function", MAKE, "  NewJoy2Twist node();\n", "joy2twist.cpp:52",
        "declares a function", "NewJoy2Twist node;"),
    class14("a class without an object", MAKE, "  ros::start();\n", "joy2twist.cpp:7",
        "no NewJoy2Twist is ever made"),
    several("a private topic to hear", [put(JOY2TWIST, '"/joy"', '"joy"'),
        put(JOY2TWIST, "NodeHandle node;", 'NodeHandle node("~");')], "C14", "joy2twist.cpp:21",
        "/joy", "puts the node's name"),
    node14("axes[6] in C++", X, "twist.linear.x = joy->axes[6];", FIELDS, "axes[6] does not exist",
        "0 to 5"),
    node14("at(12) of the buttons", X, "twist.linear.x = joy->buttons.at(12);", FIELDS,
        "buttons[12] does not exist", "out_of_range"),
    node14("a Publisher of the same name in main", PUB, f"ros::Publisher {PUB}",
        "joy2twist.cpp:22", "invalid Publisher", "is a second cmd_vel"),
    class14("a Publisher hidden in the constructor", "cmd_vel_ = ", "ros::Publisher &",
        "joy2twist.cpp:12", "invalid Publisher", "is a second cmd_vel_"),
    node14("no advertise", f"  {PUB}\n", "", "joy2twist.cpp:15", "no advertise makes"),
    several("a pointer to no Publisher", [put(JOY2TWIST, GLOBAL, "ros::Publisher* cmd_vel;\n"),
        put(JOY2TWIST, "cmd_vel.", "cmd_vel->"), put(JOY2TWIST, f"  {PUB}\n",
        f"  ros::Publisher {PUB}\n")], "C14", "joy2twist.cpp:15", "SIGSEGV", "points to nothing"),
    several("a pointer to no Twist", [put(JOY2TWIST, "Twist twist;", "Twist::Ptr twist;"),
        put(JOY2TWIST, "twist.", "twist->")], "C14", FIELDS, "px != 0", "points to nothing"),
    several("the newest Joy before a first one", [
        put(JOY2TWIST, GLOBAL, "&sensor_msgs::Joy::ConstPtr last;\n"),
        put(JOY2TWIST, BODY, "  last = joy;\n"), put(JOY2TWIST, SPIN, loop("ros::ok()",
        f"ros::spinOnce(); geometry_msgs::Twist twist; {X} {PUBLISH}".replace("joy", "last")))],
        "C14", "joy2twist.cpp:26", "px != 0", "if (last)"),
    several("a private topic to publish on", [
        put(JOY2TWIST, f"  {PUB}", '  ros::NodeHandle own("~");\n&'),
        put(JOY2TWIST, PUB, PUB.replace("node", "own").replace("/cmd_vel", "cmd_vel"))], "C15",
        "joy2twist.cpp:22", "/cmd_vel", "puts the node's name"),
    node15("publishes on another topic in C++", '"/cmd_vel"', '"/cmdvel"', "joy2twist.cpp:22",
        "/cmdvel", 'n.advertise<geometry_msgs::Twist>("/cmd_vel", 10)'),
    several("Joys published", [put(JOY2TWIST, "advertise<geometry_msgs::Twist>",
        "advertise<sensor_msgs::Joy>"), put(JOY2TWIST, PUBLISH, "cmd_vel.publish(*joy);")], "C15",
        "joy2twist.cpp:22", "/cmd_vel carries sensor_msgs/Joy"),
    several("a Publisher of the callback", [put(JOY2TWIST, f"  {PUB}\n", ""),
        put(JOY2TWIST, GLOBAL, ""), put(JOY2TWIST, CALLBACK,
        f"&  ros::NodeHandle node;\n  ros::Publisher {PUB}\n")], "C15", "joy2twist.cpp:9"),
    node16("publish forgotten in C++", f"  {PUBLISH}\n", "", "no Twist came", "publish"),
    several("axes swapped in C++", [put(JOY2TWIST, f"  {X}\n  {Z}\n",
        "  twist.linear.x = joy->axes[0];\n  twist.angular.z = joy->axes[1];\n")], "C16",
        "joy2twist.cpp:14", "swapped"),
    node16("turns the wrong way in C++", Z, "twist.angular.z = -joy->axes[0];",
        "joy2twist.cpp:14", "the sign is wrong"),
    node16("linear.z in C++", "twist.linear.x", "twist.linear.z", FIELDS, "linear.z follows"),
    node16("1 / 2", X, "twist.linear.x = 1 / 2 * joy->axes[1];", FIELDS, "linear.x is always 0",
        "1 / 2 is 0 in C++", "1.0 / 2"),
    node16("an int", X, "int speed = joy->axes[1]; twist.linear.x = speed;", FIELDS,
        "whole numbers only", "speed: an int has no decimals"),
    node16("buttons in C++", f"{X}\n  {Z}",
        "twist.linear.x = joy->buttons[1];\n  twist.angular.z = joy->buttons[0];", FIELDS,
        "msg->axes, not msg->buttons"),
    node16("published too early in C++", BODY, f"  {PUBLISH}\n  {X}\n  {Z}\n", FIELDS,
        "every Twist is zero", "first put the values"),
    node16("a zero after each Twist in C++", PUBLISH,
        "&\n  cmd_vel.publish(geometry_msgs::Twist());", "two Twists for one Joy",
        "joy2twist.cpp:16"),
    node16("only a new value is published", PUBLISH,
        f"static float last = 0;\n  if (joy->axes[1] != last) {PUBLISH}\n  last = joy->axes[1];",
        "joy2twist.cpp:16", "no Twist for the same Joy again"),
    node16("nothing at rest in C++", PUBLISH, f"if (joy->axes[1] != 0) {PUBLISH}",
        "joy2twist.cpp:15", "no Twist for a Joy", "for every Joy"),
    several("a sum in C++", [*KEPT, put(JOY2TWIST, "linear.x =", "linear.x +=")], "C16",
        "joy2twist.cpp:13", "depends on earlier Joys"),
    several("the last speed kept at rest", [*KEPT, put(JOY2TWIST, X,
        f"if (joy->axes[1] != 0) {X}")], "C16", "joy2twist.cpp:13", "the robot drives on"),
    several("Twists from a clock", [*KEPT, put(JOY2TWIST, f"  {PUBLISH}\n", ""),
        put(JOY2TWIST, SPIN, loop("ros::ok()", f"ros::spinOnce(); {PUBLISH}"))], "C16",
        "joy2twist.cpp:26", "from a clock of its own", "end with ros::spin()"),
    node16("sleep in the callback in C++", CALLBACK, "&  ros::Duration(0.5).sleep();\n",
        "joy2twist.cpp:9", "the callback sleeps"),
    node17("a Rate in the callback", PUBLISH, "&\n  ros::Rate(15).sleep();", "joy2twist.cpp:16",
        "no sleep and no Rate in the callback"),
    node17("spin in the callback", PUBLISH, "&\n  ros::spin();", "joy2twist.cpp:16",
        "another ros::spin()", "at the end of main"),
    node34("while (true)", SPIN, loop("true", "ros::spinOnce();"), "joy2twist.cpp:25",
        "had to be killed", "while (ros::ok())"),
    several("type of a script", [put(STICK, 'type="joy2twist"', 'type="joy2twist.cpp"')], "C21",
        "launch/launch_joy_node.launch:5", 'type="joy2twist"'),
    several("remap swapped in C++", [put(TURTLEBOT, TO_TELEOP,
        'from="/cmd_vel_mux/input/teleop" to="/cmd_vel"')], "C27",
        "launch/joy2twist_turtlebot.launch:3", "from and to are swapped"),
    several("no node in the launch file", [put(TURTLEBOT, 'pkg="joy2twist" name="myjoystick2twist"'
        ' type="joy2twist"', 'pkg="rostopic" name="list" type="rostopic"')], "C27",
        'type="joy2twist" name="myjoystick2twist"'),
]  # fmt: skip
