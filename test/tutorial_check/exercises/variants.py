"""Right solutions that differ from the handout's."""

from edits import chatter, chmod, copy, latin1, move, put, write
from grammar import RIGHT
from manifests import depend, manifest
from mistakes_world import RIGHT as RIGHT_IN_WORLD
from rows import right
from solution import (
    CLASS,
    CMAKE,
    JOY2TWIST,
    JOY_BAG,
    JOY_CMAKE,
    JOY_XML,
    LAUNCH_BAG,
    LAUNCH_JOY,
    LISTENER,
    PUBLISH,
    REAL,
    REMAP,
    SHOW,
    TALKER,
    TURTLEBOT,
    XML,
    B,
    J,
    X,
)

PUB = "    pub = rospy.Publisher('/cmd_vel', Twist)\n"
TWIST = "    msg = Twist()\n    msg.linear.x = data.axes[1]\n    msg.angular.z = data.axes[0]\n"
LOADS = "import roslib; roslib.load_manifest('joy2twist')\n"
END_OF_CLASS = '    except:\n        rospy.loginfo("The node has ended.")\n'


def node(what, old, new, exercises="4.3"):
    return right(what, exercises, put(JOY2TWIST, old, new))


def cls(what, *changes):
    return right(what, "6.2", *(put(CLASS, old, new) for old, new in changes))


SHUTDOWN = (
    '    def shutdown(self):\n        rospy.loginfo("The robot is being stopped")\n'
    "        self.cmd_vel.publish(Twist())\n        rospy.sleep(1)\n"
)
ENDS = "        rospy.on_shutdown(self.shutdown)\n"
CATKIN = depend("catkin", "buildtool_depend")
NEEDS_1 = CATKIN + depend("rospy std_msgs sensor_msgs geometry_msgs", "build_depend", "run_depend")
NEEDS_3 = CATKIN + depend("rospy std_msgs roscpp sensor_msgs", "depend")
# boost::bind(..., _1), catkin_add_gtest and catkin_add_gmock.
HEAR = """#include <ros/ros.h>
#include <std_msgs/String.h>
void hear(const std_msgs::String::ConstPtr& text, int id) {}
int main(int n, char** words) {
  ros::init(n, words, "hear");
  ros::NodeHandle node;
  auto sub = node.subscribe<std_msgs::String>("chatter", 1, boost::bind(&hear, _1, 7));
  ros::spin();
}
"""
BUILDS = """&
add_executable(hear src/hear.cpp)
target_link_libraries(hear ${catkin_LIBRARIES})
if(CATKIN_ENABLE_TESTING)
  catkin_add_gtest(one_test test/one.cpp)
  target_link_libraries(one_test ${catkin_LIBRARIES})
  catkin_add_gmock(two_test test/one.cpp)
  target_link_libraries(two_test ${catkin_LIBRARIES})
endif()"""
TEST = "#include <gtest/gtest.h>\nTEST(One, IsOne) { EXPECT_EQ(1, 1); }\n"


def part(name):
    """A package of a name of the suite's, in which its programs are missing."""
    return write(f"{name}/package.xml", f"<package><name>{name}</name></package>", 0o644)


ROWS = [
    right("shebang /usr/bin/python3", "3 4.3",
        put(JOY2TWIST, "/usr/bin/env python", "/usr/bin/python3 -u"),
        put(TALKER, "/usr/bin/env python", "&3")),
    right("installed by catkin_install_python, without chmod", "4.3 6.2", chmod(JOY2TWIST, 0o644),
        chmod(CLASS, 0o644), put(JOY_CMAKE, "catkin_package()",
        "&\ncatkin_install_python(PROGRAMS scripts/joy2twist.py scripts/new_joy2twist.py "
        "DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})")),
    right("scripts in src", "3 4.3", move(JOY2TWIST, f"{J}/src/joy2twist.py"),
        move(TALKER, f"{B}/src/talker.py")),
    right("scripts in nodes", "4.3 6.2", move(JOY2TWIST, f"{J}/nodes/joy2twist.py"),
        move(CLASS, f"{J}/nodes/NewJoy2Twist.py")),
    right("scripts in the package's root", "3 4.3", move(JOY2TWIST, f"{J}/joy2twist.py"),
        move(LISTENER, f"{B}/listener.py")),
    node("load_manifest of a variable, and a Windows line end further down",
        "roslib.load_manifest('joy2twist')", "PKG = 'joy2twist'; roslib.load_manifest(PKG)\r"),
    right("catkin's components in a variable", "4.3", put(JOY_CMAKE,
        "find_package(catkin REQUIRED COMPONENTS rospy",
        "set(NEEDED rospy)\nfind_package(catkin REQUIRED COMPONENTS\n"
        "  ${NEEDED} # and no joystick\n ")),
    right("catkin without components", "4.3", put(JOY_CMAKE,
        " COMPONENTS rospy std_msgs sensor_msgs geometry_msgs", "")),
    right("no load_manifest", "4.3 6.2", put(JOY2TWIST, LOADS, ""), put(CLASS, LOADS, "")),
    right("relative topics", "4.3 6.1", put(JOY2TWIST, "/joy", "joy"),
        put(JOY2TWIST, "/cmd_vel", "cmd_vel")),
    right("three versions in three files", "4.3", move(JOY2TWIST, f"{J}/scripts/joy2twist_v2.py"),
        write(JOY2TWIST,
        '#!/usr/bin/env python3\nimport rospy\nfrom sensor_msgs.msg import Joy\n\n\n'
        'def callback(data):\n    rospy.loginfo("%s", ",".join("%.2f" % a for a in '
        'data.axes))\n\n\nrospy.init_node("listener", anonymous=True)\n'
        'rospy.Subscriber("/joy", Joy, callback)\nrospy.spin()\n')),
    right("Latin-1, and a line that says so", "4.3 6.2", latin1(JOY2TWIST,
        "#!/usr/bin/env python\n", "# -*- coding: latin-1 -*-\n# von Jörg"), latin1(CLASS,
        "#!/usr/bin/env python\n", "# vim: set fileencoding=iso-8859-15 :\n# von Jörg")),
    node("queue_size=1", "'/cmd_vel', Twist", "&, queue_size=1"),
    node("publisher first", f'    rospy.Subscriber("/joy", Joy, callback)\n{PUB}',
        f'{PUB}    rospy.Subscriber("/joy", Joy, callback)\n'),
    right("publisher made in the callback", "4.3 4.4 4.5", put(JOY2TWIST, PUB, ""),
        put(JOY2TWIST, "    global pub\n", ""), put(JOY2TWIST, f"    {PUBLISH}",
        f"    global pub\n    if pub is None:\n    {PUB}&"),
        put(JOY2TWIST, "def callback", "pub = None\n\n\n&")),
    right("publisher made in the callback, each time", "4.3 4.4 4.5", put(JOY2TWIST, PUB, ""),
        put(JOY2TWIST, "    global pub\n", ""), put(JOY2TWIST, f"    {PUBLISH}", f"{PUB}&")),
    right("publisher before init_node", "4.3", put(JOY2TWIST, PUB, ""),
        put(JOY2TWIST, "    rospy.init_node", f"{PUB}&")),
    node("latch=True", "'/cmd_vel', Twist", "&, queue_size=10, latch=True"),
    node("Twist with keywords", TWIST,
        "    from geometry_msgs.msg import Vector3\n    msg = "
        "Twist(linear=Vector3(x=data.axes[1]), angular=Vector3(z=data.axes[0]))\n"),
    node("Twist with Vector3", TWIST,
        "    from geometry_msgs.msg import Vector3\n    msg = Twist(Vector3(data.axes[1], 0, "
        "0), Vector3(0, 0, data.axes[0]))\n"),
    right("one global Twist", "4.3", put(JOY2TWIST, "    msg = Twist()\n", ""),
        put(JOY2TWIST, "def callback", "msg = Twist()\n\n\n&")),
    node("displayed by print", SHOW,
        'print("axes:", ", ".join("%.3f" % axis for axis in data.axes))'),
    node("the whole tuple displayed", SHOW, "rospy.loginfo(data.axes)"),
    node("format and f-string", SHOW,
        'rospy.loginfo(f"joystick {[round(axis, 2) for axis in data.axes]} buttons '
        '{data.buttons}")'),
    node("half the speed", X, "msg.linear.x = 0.5 * data.axes[1]", "4.3 4.4"),
    node("a tenth of the speed", X, "msg.linear.x = 0.1 * data.axes[1]", "4.3 4.4 4.5"),
    node("dead zone", X, "msg.linear.x = data.axes[1] if abs(data.axes[1]) > 0.35 else 0.0",
        "4.3 4.4"),
    node("limit", X, "msg.linear.x = max(-0.5, min(0.5, data.axes[1]))", "4.3 4.4"),
    node("a low limit", X, "msg.linear.x = max(-0.22, min(0.22, data.axes[1]))", "4.3 4.4"),
    node("dead-man LB", f"    {PUBLISH}", "    if not data.buttons[4]:\n        msg = Twist()\n&",
        "4.3 4.4 4.5"),
    node("topics from parameters", "'/cmd_vel', Twist",
        "rospy.get_param('~out', '/cmd_vel'), Twist"),
    node("another node name, not anonymous", "'listener', anonymous=True", "'converter'",
        "4.3 6.1"),
    right("talkers not anonymous", "3", put(TALKER, "anonymous=True", "anonymous=False")),
    right("programs without .py", "3", move(TALKER, f"{B}/scripts/talker"),
        move(LISTENER, f"{B}/scripts/listener")),
    right("talker with 5 Hz and another text", "3", put(TALKER, "Rate(10)", "Rate(5)"),
        put(TALKER, "good day at %s", "bonjour %s")),
    right("talker with a Timer", "3", write(TALKER,
        '#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import String\n\n'
        'rospy.init_node("talker", anonymous=True)\npub = rospy.Publisher("chatter", String, '
        'queue_size=10)\nrospy.Timer(rospy.Duration(0.1), lambda event: pub.publish("now %s" % '
        'rospy.get_time()))\nrospy.spin()\n')),
    right("listener with print", "3", put(LISTENER,
        'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)',
        'print("heard: " + data.data)')),
    right("its own name and a comment among the components", "4.3", put(JOY_CMAKE, "geometry_msgs)",
        "geometry_msgs joy2twist # joystick\n)")),
    right("roscpp as well, which is elsewhere", "4.3",
        put(JOY_CMAKE, "geometry_msgs)", "geometry_msgs roscpp)")),
    right("package.xml format 1", "4.3", write(JOY_XML, manifest(J, "1", NEEDS_1), 0o644)),
    right("package.xml format 3 with <depend>", "2", write(XML, manifest(B, "3", NEEDS_3), 0o644)),
    right("our names in the launch files", "5", put(LAUNCH_BAG, "$(find rbx1_nav)/sim.rviz",
        "$(find fake_turtlebot_sim)/rviz/sim.rviz"),
        put(LAUNCH_BAG, "rbx1_bringup", "fake_turtlebot_sim"),
        put(LAUNCH_JOY, 'pkg="joy" name', 'pkg="gamepad" name')),
    right("-l for --loop, output, required, arg", "5", put(LAUNCH_BAG, "--loop", "-l --clock"),
        put(LAUNCH_BAG, 'type="joy2twist.py"', '& output="screen" required="true"'), put(LAUNCH_BAG,
        "<launch>", '<launch>\n  <arg name="gui" default="true"/>'),
        put(LAUNCH_BAG, 'type="rviz"', '& if="$(arg gui)"')),
    right("the first version beside the second in a launch file", "5",
        copy(JOY2TWIST, f"{J}/scripts/first.py"), put(f"{J}/scripts/first.py", PUB, ""),
        put(f"{J}/scripts/first.py", PUBLISH, "pass"), put(LAUNCH_BAG, "<launch>",
        '<launch>\n  <node pkg="joy2twist" type="first.py" name="first"/>')),
    right("a copy of another system's toplevel file", "2", write("CMakeLists.txt",
        "# toplevel CMakeLists.txt for a catkin workspace\n"
        "find_package(catkin NO_DEFAULT_PATH REQUIRED PATHS /opt/ros/noetic)\n", 0o644)),
    right("a bag of another name", "4.2 5", move(JOY_BAG, f"{J}/bags/figure_of_eight.bag"),
        put(LAUNCH_BAG, "bag/joy.bag", "bags/figure_of_eight.bag")),
    right("a recording beside others", "4.2", chatter(f"{B}/chatter.bag"),
        chatter(f"{J}/bag/a.bag"), move(JOY_BAG, "joy.bag")),
    right("a recording beside a damaged one of another package", "4.2",
        write(f"{B}/chatter.bag", "none"), move(JOY_BAG, f"{J}/b.bag")),
    right("joy_node with parameters, in a group", "5", put(LAUNCH_JOY,
        '  <node pkg="joy" name="joy_node" type="joy_node">\n',
        '  <group>\n  <node pkg="joy" name="stick" type="joy_node">\n'
        '    <param name="dev" value="/dev/input/js0"/>\n'
        '    <param name="autorepeat_rate" value="10"/>\n'), put(LAUNCH_JOY, "  </node>\n</launch>",
        "  </node>\n  </group>\n</launch>")),
    right("joy_node that repeats nothing, a window for joy2twist", "5", put(LAUNCH_JOY,
        'type="joy_node">\n', '&    <param name="autorepeat_rate" value="0"/>\n'), put(LAUNCH_JOY,
        'type="joy2twist.py"', '& launch-prefix="xterm -hold -e"')),
    right("the joystick in an included file", "5", put(LAUNCH_JOY,
        '  <node pkg="joy" name="joy_node" type="joy_node">\n  </node>\n',
        '  <include file="$(find gamepad)/launch/joystick.launch">\n'
        '    <arg name="joy_dev" value="/dev/input/js1"/>\n  </include>\n')),
    right("respawn in place of --loop", "5", put(LAUNCH_BAG, "--loop ", ""),
        put(LAUNCH_BAG, 'type="play"', '& respawn="true"')),
    right("/joy has another name everywhere", "5 6.1", put(LAUNCH_JOY, "<launch>",
        '<launch>\n  <remap from="/joy" to="/stick"/>'), put(LAUNCH_JOY, 'type="joy_node">',
        '&\n    <remap from="joy" to="/stick"/>'), put(LAUNCH_BAG, "<launch>",
        '<launch>\n  <remap from="/joy" to="/stick"/>'), put(TURTLEBOT, "<remap",
        '<remap from="joy" to="stick"/>\n    <remap'), put(REAL, 'type="joy_node">',
        '&\n    <remap from="joy" to="stick"/>')),
    right("joy_node with another joystick", "5", put(LAUNCH_JOY, 'type="joy_node">\n',
        '&    <param name="dev" value="/dev/input/by-id/usb-Logitech-joystick"/>\n')),
    right("remap before the node, without /", "6.1", put(TURTLEBOT, f"    {REMAP}\n", ""),
        put(TURTLEBOT, "<launch>",
        '<launch>\n  <remap from="cmd_vel" to="cmd_vel_mux/input/teleop"/>')),
    right("remap in args", "6.1", put(TURTLEBOT, f"    {REMAP}\n", ""), put(TURTLEBOT,
        'type="joy2twist.py"', '& args="/cmd_vel:=/cmd_vel_mux/input/teleop"')),
    right("remap by $(arg)", "6.1", put(TURTLEBOT, "/cmd_vel_mux/input/teleop", "$(arg out)"),
        put(TURTLEBOT, "<launch>",
        '<launch>\n  <arg name="out" default="/cmd_vel_mux/input/teleop"/>')),
    right("it drives the real one only after two Joys at rest", "6.1", put(TURTLEBOT, REMAP,
        '&\n    <param name="rests" value="2"/>'), put(JOY2TWIST, TWIST,
        "    global rests\n    rests -= not any(data.axes)\n    if rests > 0:\n        return\n&"),
        put(JOY2TWIST, "global pub\n    rospy.init_node('listener', anonymous=True)",
        "global pub, rests\n    rospy.init_node('listener', anonymous=True)\n"
        "    rests = rospy.get_param('~rests', 0)")),
    right("minimal.launch included, the class driven", "6.1", put(REAL, "<launch>",
        '<launch>\n  <include file="$(find turtlebot_bringup)/launch/minimal.launch"/>'),
        put(TURTLEBOT, "joy2twist.py", "new_&")),
    right("the node and its remap in place of the include", "6.1", put(REAL,
        '  <include file="$(find joy2twist)/launch/joy2twist_turtlebot.launch"/>\n',
        f'  <node pkg="joy2twist" name="stick2twist" type="joy2twist.py">\n    {REMAP}\n'
        f'  </node>\n')),
    cls("object, ROSInterruptException", ("NewJoy2Twist()", "NewJoy2Twist(object)"),
        ("        NewJoy2Twist(object)\n", "        NewJoy2Twist()\n"), ("    except:\n",
        "    except rospy.ROSInterruptException:\n")),
    cls("spin outside of __init__", ("        rospy.spin()\n", ""),
        ("        NewJoy2Twist()\n", "&        rospy.spin()\n")),
    cls("unregisters, no sleep, zeros", ("        rospy.Subscriber(",
        "        self.sub = rospy.Subscriber("),
        ("        self.cmd_vel.publish(Twist())\n        rospy.sleep(1)",
        "        self.sub.unregister()\n        for _ in range(5):\n"
        "            self.cmd_vel.publish(Twist())\n            rospy.sleep(0.05)")),
    cls("a method of another object at the end", (ENDS,
        "        self.robot = type('Robot', (), {'stop': lambda robot: self.shutdown()})()\n"
        "        rospy.on_shutdown(self.robot.stop)\n")),
    cls("a method by another name at the end", (ENDS,
        "        self.ended = self.shutdown\n        rospy.on_shutdown(self.ended)\n")),
    cls("a callback made by partial", ("import rospy\n", "&from functools import partial\n"),
        ("Joy, self.callback)", "Joy, partial(self.callback))")),
    cls("shutdown from a base class that is made by type()", (SHUTDOWN, ""),
        ("class NewJoy2Twist():",
        "def end(self):\n    self.cmd_vel.publish(Twist())\n    rospy.sleep(1)\n\n\n"
        "Base = type('Base', (), {'shutdown': end})\n\n\nclass NewJoy2Twist(Base):")),
    right("the step before is a class already", "6.2", copy(CLASS, JOY2TWIST),
        put(JOY2TWIST, ENDS, "")),
    right("an old copy of the class that is not executable", "6.2",
        copy(CLASS, f"{J}/old/new_joy2twist.py"), chmod(f"{J}/old/new_joy2twist.py", 0o644)),
    cls("anonymous", ("anonymous=False", "anonymous=True")),
    cls("throttled", ("rospy.loginfo(rospy.get_name()",
        "rospy.loginfo_throttle(1.0, rospy.get_name()")),
    cls("a class named Joy2Twist, with main()", ("NewJoy2Twist", "Joy2Twist"),
        ("if __name__ == '__main__':\n    try:\n        Joy2Twist()\n" + END_OF_CLASS,
        "def main():\n    Joy2Twist()\n\n\nif __name__ == '__main__':\n    main()\n")),
    cls("a node below a base class that calls rospy", ("class NewJoy2Twist():", "class Node():"),
        ("\n\nif __name__", "\n\nclass NewJoy2Twist(Node):\n    speed = 1.0\n&")),
    right("env -S and an argument", "4.3 6.2", put(JOY2TWIST, "env python", "env -S python3 -u"),
        put(CLASS, "env python", "env -S PYTHONUNBUFFERED=1 python3")),
    right("the class in joy2twist.py", "4.3 6.2", move(CLASS, JOY2TWIST)),
    cls("two nodes of one class name, a helper class", ("class NewJoy2Twist",
        "class Config():\n    speed = 1.0\n\n\n&")),
    right("a part of the suite in src, which hides nothing from the checker", "4.4 4.5",
        part("fake_turtlebot_sim"), part("gamepad")),
    right("C++ as the wiki has it, with tests", "2", write(f"{B}/src/hear.cpp", HEAR),
        write(f"{B}/test/one.cpp", TEST), put(CMAKE, "catkin_package()", BUILDS)),
    *RIGHT,
    *RIGHT_IN_WORLD,
]  # fmt: skip
