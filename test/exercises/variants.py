"""Right solutions that differ from the handout's, each a row: (what, edits, exercises to check)."""

from edits import *
from grammar import RIGHT
from mistakes_world import RIGHT as RIGHT_IN_WORLD

PUB = "    pub = rospy.Publisher('/cmd_vel', Twist)\n"
TWIST = "    msg = Twist()\n    msg.linear.x = data.axes[1]\n    msg.angular.z = data.axes[0]\n"
MANIFEST = "import roslib; roslib.load_manifest('joy2twist')\n"
END_OF_CLASS = '    except:\n        rospy.loginfo("The node has ended.")\n'


def j(what, old, new):
    return (what, [put(JOY2TWIST, old, new)], ["4.3"])


def c(what, *changes):
    return (what, [put(CLASS, old, new) for old, new in changes], ["6.2"])


SHUTDOWN = '    def shutdown(self):\n        rospy.loginfo("The robot is being stopped")\n        self.cmd_vel.publish(Twist())\n        rospy.sleep(1)\n'
ENDS = "        rospy.on_shutdown(self.shutdown)\n"
MAKES = "        self.cmd_vel = rospy.Publisher('/cmd_vel', Twist)\n"
# Of which a note is looked for, too.
REPORTS = c(
    "an except that reports, the publisher first",
    (ENDS + MAKES, MAKES + ENDS),
    ("    except:\n", "    except Exception as error:\n"),
    ('"The node has ended."', 'f"Error: {error}"'),
)


# boost::bind(..., _1), catkin_add_gtest and catkin_add_gmock.
CPP = [
    write(f"{B}/src/hear.cpp", '#include <ros/ros.h>\n#include <std_msgs/String.h>\nvoid hear(const std_msgs::String::ConstPtr& text, int id) {}\nint main(int n, char** words) {\n  ros::init(n, words, "hear");\n  ros::NodeHandle node;\n  auto sub = node.subscribe<std_msgs::String>("chatter", 1, boost::bind(&hear, _1, 7));\n  ros::spin();\n}\n'),
    write(f"{B}/test/one.cpp", "#include <gtest/gtest.h>\nTEST(One, IsOne) { EXPECT_EQ(1, 1); }\n"),
    put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package()\nadd_executable(hear src/hear.cpp)\ntarget_link_libraries(hear ${catkin_LIBRARIES})\nif(CATKIN_ENABLE_TESTING)\n  catkin_add_gtest(one_test test/one.cpp)\n  target_link_libraries(one_test ${catkin_LIBRARIES})\n  catkin_add_gmock(two_test test/one.cpp)\n  target_link_libraries(two_test ${catkin_LIBRARIES})\nendif()"),
]  # fmt: skip


def part(name):
    """A package of a name of the suite's, in which its programs are missing."""
    return write(f"{name}/package.xml", f"<package><name>{name}</name></package>", 0o644)


ROWS = [
    ("shebang /usr/bin/python3", [put(JOY2TWIST, "/usr/bin/env python", "/usr/bin/python3 -u"), put(TALKER, "/usr/bin/env python", "/usr/bin/env python3")], ["3", "4.3"]),
    ("installed by catkin_install_python, without chmod", [chmod(JOY2TWIST, 0o644), chmod(CLASS, 0o644), put(f"{J}/CMakeLists.txt", "catkin_package()", "catkin_package()\ncatkin_install_python(PROGRAMS scripts/joy2twist.py scripts/new_joy2twist.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})")], ["4.3", "6.2"]),
    ("scripts in src", [move(JOY2TWIST, f"{J}/src/joy2twist.py"), move(TALKER, f"{B}/src/talker.py")], ["3", "4.3"]),
    ("scripts in nodes", [move(JOY2TWIST, f"{J}/nodes/joy2twist.py"), move(CLASS, f"{J}/nodes/NewJoy2Twist.py")], ["4.3", "6.2"]),
    ("scripts in the package's root", [move(JOY2TWIST, f"{J}/joy2twist.py"), move(LISTENER, f"{B}/listener.py")], ["3", "4.3"]),
    ("load_manifest of a variable, and a Windows line end further down", [put(JOY2TWIST, "roslib.load_manifest('joy2twist')", "PKG = 'joy2twist'; roslib.load_manifest(PKG)\r")], ["4.3"]),
    ("catkin's components in a variable", [put(f"{J}/CMakeLists.txt", "find_package(catkin REQUIRED COMPONENTS rospy", "set(NEEDED rospy)\nfind_package(catkin REQUIRED COMPONENTS\n  ${NEEDED} # and no joystick\n ")], ["4.3"]),
    ("catkin without components", [put(f"{J}/CMakeLists.txt", " COMPONENTS rospy std_msgs sensor_msgs geometry_msgs", "")], ["4.3"]),
    ("no load_manifest", [put(JOY2TWIST, MANIFEST, ""), put(CLASS, MANIFEST, "")], ["4.3", "6.2"]),
    ("relative topics", [put(JOY2TWIST, "/joy", "joy"), put(JOY2TWIST, "/cmd_vel", "cmd_vel")], ["4.3", "6.1"]),
    ("three versions in three files", [move(JOY2TWIST, f"{J}/scripts/joy2twist_v2.py"), write(JOY2TWIST, '#!/usr/bin/env python3\nimport rospy\nfrom sensor_msgs.msg import Joy\n\n\ndef callback(data):\n    rospy.loginfo("%s", ",".join("%.2f" % a for a in data.axes))\n\n\nrospy.init_node("listener", anonymous=True)\nrospy.Subscriber("/joy", Joy, callback)\nrospy.spin()\n')], ["4.3"]),
    ("Latin-1, and a line that says so", [latin1(JOY2TWIST, "#!/usr/bin/env python\n", "# -*- coding: latin-1 -*-\n# von Jörg"), latin1(CLASS, "#!/usr/bin/env python\n", "# vim: set fileencoding=iso-8859-15 :\n# von Jörg")], ["4.3", "6.2"]),
    j("queue_size=1", "'/cmd_vel', Twist", "'/cmd_vel', Twist, queue_size=1"),
    j("publisher first", f'    rospy.Subscriber("/joy", Joy, callback)\n{PUB}', f'{PUB}    rospy.Subscriber("/joy", Joy, callback)\n'),
    ("publisher made in the callback", [put(JOY2TWIST, PUB, ""), put(JOY2TWIST, "    global pub\n", ""), put(JOY2TWIST, f"    {PUBLISH}", f"    global pub\n    if pub is None:\n    {PUB}    {PUBLISH}"), put(JOY2TWIST, "def callback", "pub = None\n\n\ndef callback")], ["4.3", "4.4", "4.5"]),
    ("publisher made in the callback, each time", [put(JOY2TWIST, PUB, ""), put(JOY2TWIST, "    global pub\n", ""), put(JOY2TWIST, f"    {PUBLISH}", f"{PUB}    {PUBLISH}")], ["4.3", "4.4", "4.5"]),
    ("publisher before init_node", [put(JOY2TWIST, PUB, ""), put(JOY2TWIST, "    rospy.init_node", f"{PUB}    rospy.init_node")], ["4.3"]),
    j("latch=True", "'/cmd_vel', Twist", "'/cmd_vel', Twist, queue_size=10, latch=True"),
    j("Twist with keywords", TWIST, "    from geometry_msgs.msg import Vector3\n    msg = Twist(linear=Vector3(x=data.axes[1]), angular=Vector3(z=data.axes[0]))\n"),
    j("Twist with Vector3", TWIST, "    from geometry_msgs.msg import Vector3\n    msg = Twist(Vector3(data.axes[1], 0, 0), Vector3(0, 0, data.axes[0]))\n"),
    ("one global Twist", [put(JOY2TWIST, "    msg = Twist()\n", ""), put(JOY2TWIST, "def callback", "msg = Twist()\n\n\ndef callback")], ["4.3"]),
    j("displayed by print", SHOW, 'print("axes:", ", ".join("%.3f" % axis for axis in data.axes))'),
    j("the whole tuple displayed", SHOW, "rospy.loginfo(data.axes)"),
    j("format and f-string", SHOW, 'rospy.loginfo(f"joystick {[round(axis, 2) for axis in data.axes]} buttons {data.buttons}")'),
    ("half the speed", [put(JOY2TWIST, X, "msg.linear.x = 0.5 * data.axes[1]")], ["4.3", "4.4"]),
    ("a tenth of the speed", [put(JOY2TWIST, X, "msg.linear.x = 0.1 * data.axes[1]")], ["4.3", "4.4", "4.5"]),
    ("dead zone", [put(JOY2TWIST, X, "msg.linear.x = data.axes[1] if abs(data.axes[1]) > 0.35 else 0.0")], ["4.3", "4.4"]),
    ("limit", [put(JOY2TWIST, X, "msg.linear.x = max(-0.5, min(0.5, data.axes[1]))")], ["4.3", "4.4"]),
    ("a low limit", [put(JOY2TWIST, X, "msg.linear.x = max(-0.22, min(0.22, data.axes[1]))")], ["4.3", "4.4"]),
    ("dead-man LB", [put(JOY2TWIST, f"    {PUBLISH}", f"    if not data.buttons[4]:\n        msg = Twist()\n    {PUBLISH}")], ["4.3", "4.4", "4.5"]),
    ("topics from parameters", [put(JOY2TWIST, "'/cmd_vel', Twist", "rospy.get_param('~out', '/cmd_vel'), Twist")], ["4.3"]),
    ("another node name, not anonymous", [put(JOY2TWIST, "'listener', anonymous=True", "'converter'")], ["4.3", "6.1"]),
    ("talkers not anonymous", [put(TALKER, "anonymous=True", "anonymous=False")], ["3"]),
    ("programs without .py", [move(TALKER, f"{B}/scripts/talker"), move(LISTENER, f"{B}/scripts/listener")], ["3"]),
    ("talker with 5 Hz and another text", [put(TALKER, "Rate(10)", "Rate(5)"), put(TALKER, "good day at %s", "bonjour %s")], ["3"]),
    ("talker with a Timer", [write(TALKER, '#!/usr/bin/env python3\nimport rospy\nfrom std_msgs.msg import String\n\nrospy.init_node("talker", anonymous=True)\npub = rospy.Publisher("chatter", String, queue_size=10)\nrospy.Timer(rospy.Duration(0.1), lambda event: pub.publish("now %s" % rospy.get_time()))\nrospy.spin()\n')], ["3"]),
    ("listener with print", [put(LISTENER, 'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)', 'print("heard: " + data.data)')], ["3"]),
    ("its own name and a comment among the components", [put(f"{J}/CMakeLists.txt", "geometry_msgs)", "geometry_msgs joy2twist # joystick\n)")], ["4.3"]),
    ("roscpp as well, which is elsewhere", [put(f"{J}/CMakeLists.txt", "geometry_msgs)", "geometry_msgs roscpp)")], ["4.3"]),
    ("package.xml format 1", [write(f"{J}/package.xml", f"<package>\n<name>{J}</name>\n<version>0.0.0</version>\n<description>x</description>\n<maintainer email='s@u.example'>s</maintainer>\n<license>TODO</license>\n<buildtool_depend>catkin</buildtool_depend>\n" + "".join(f"<build_depend>{d}</build_depend>\n<run_depend>{d}</run_depend>\n" for d in ("rospy", "std_msgs", "sensor_msgs", "geometry_msgs")) + "</package>\n", 0o644)], ["4.3"]),
    ("package.xml format 3 with <depend>", [write(f"{B}/package.xml", f"<package format='3'>\n<name>{B}</name>\n<version>0.0.0</version>\n<description>x</description>\n<maintainer email='s@u.example'>s</maintainer>\n<license>TODO</license>\n<buildtool_depend>catkin</buildtool_depend>\n" + "".join(f"<depend>{d}</depend>\n" for d in ("rospy", "std_msgs", "roscpp", "sensor_msgs")) + "</package>\n", 0o644)], ["2"]),
    ("our names in the launch files", [put(LAUNCH_BAG, "$(find rbx1_nav)/sim.rviz", "$(find fake_turtlebot_sim)/rviz/sim.rviz"), put(LAUNCH_BAG, "rbx1_bringup", "fake_turtlebot_sim"), put(LAUNCH_JOY, 'pkg="joy" name', 'pkg="gamepad" name')], ["5"]),
    ("-l for --loop, output, required, arg", [put(LAUNCH_BAG, "--loop", "-l --clock"), put(LAUNCH_BAG, 'type="joy2twist.py"', 'type="joy2twist.py" output="screen" required="true"'), put(LAUNCH_BAG, "<launch>", '<launch>\n  <arg name="gui" default="true"/>'), put(LAUNCH_BAG, 'type="rviz"', 'type="rviz" if="$(arg gui)"')], ["5"]),
    ("the first version beside the second in a launch file", [copy(JOY2TWIST, f"{J}/scripts/first.py"), put(f"{J}/scripts/first.py", PUB, ""), put(f"{J}/scripts/first.py", PUBLISH, "pass"), put(LAUNCH_BAG, "<launch>", '<launch>\n  <node pkg="joy2twist" type="first.py" name="first"/>')], ["5"]),
    ("a copy of another system's toplevel file", [write("CMakeLists.txt", "# toplevel CMakeLists.txt for a catkin workspace\nfind_package(catkin NO_DEFAULT_PATH REQUIRED PATHS /opt/ros/noetic)\n", 0o644)], ["2"]),
    ("a bag of another name", [move(f"{J}/bag/joy.bag", f"{J}/bags/figure of eight.bag".replace(" ", "_")), put(LAUNCH_BAG, "bag/joy.bag", "bags/figure_of_eight.bag")], ["4.2", "5"]),
    ("a recording beside others", [chatter(f"{B}/chatter.bag"), chatter(f"{J}/bag/a.bag"), move(f"{J}/bag/joy.bag", "joy.bag")], ["4.2"]),
    ("a recording beside a damaged one of another package", [write(f"{B}/chatter.bag", "none"), move(f"{J}/bag/joy.bag", f"{J}/b.bag")], ["4.2"]),
    ("joy_node with parameters, in a group", [put(LAUNCH_JOY, '  <node pkg="joy" name="joy_node" type="joy_node">\n', '  <group>\n  <node pkg="joy" name="stick" type="joy_node">\n    <param name="dev" value="/dev/input/js0"/>\n    <param name="autorepeat_rate" value="10"/>\n'), put(LAUNCH_JOY, "  </node>\n</launch>", "  </node>\n  </group>\n</launch>")], ["5"]),
    ("joy_node that repeats nothing, a window for joy2twist", [put(LAUNCH_JOY, 'type="joy_node">\n', 'type="joy_node">\n    <param name="autorepeat_rate" value="0"/>\n'), put(LAUNCH_JOY, 'type="joy2twist.py"', 'type="joy2twist.py" launch-prefix="xterm -hold -e"')], ["5"]),
    ("the joystick in an included file", [put(LAUNCH_JOY, '  <node pkg="joy" name="joy_node" type="joy_node">\n  </node>\n', '  <include file="$(find gamepad)/launch/joystick.launch">\n    <arg name="joy_dev" value="/dev/input/js1"/>\n  </include>\n')], ["5"]),
    ("respawn in place of --loop", [put(LAUNCH_BAG, "--loop ", ""), put(LAUNCH_BAG, 'type="play"', 'type="play" respawn="true"')], ["5"]),
    ("/joy has another name everywhere", [put(LAUNCH_JOY, "<launch>", '<launch>\n  <remap from="/joy" to="/stick"/>'), put(LAUNCH_JOY, 'type="joy_node">', 'type="joy_node">\n    <remap from="joy" to="/stick"/>'), put(LAUNCH_BAG, "<launch>", '<launch>\n  <remap from="/joy" to="/stick"/>'), put(TURTLEBOT, "<remap", '<remap from="joy" to="stick"/>\n    <remap'), put(REAL, 'type="joy_node">', 'type="joy_node">\n    <remap from="joy" to="stick"/>')], ["5", "6.1"]),
    ("joy_node with another joystick", [put(LAUNCH_JOY, 'type="joy_node">\n', 'type="joy_node">\n    <param name="dev" value="/dev/input/by-id/usb-Logitech-joystick"/>\n')], ["5"]),
    ("remap before the node, without /", [put(TURTLEBOT, f"    {REMAP}\n", ""), put(TURTLEBOT, "<launch>", '<launch>\n  <remap from="cmd_vel" to="cmd_vel_mux/input/teleop"/>')], ["6.1"]),
    ("remap in args", [put(TURTLEBOT, f"    {REMAP}\n", ""), put(TURTLEBOT, 'type="joy2twist.py"', 'type="joy2twist.py" args="/cmd_vel:=/cmd_vel_mux/input/teleop"')], ["6.1"]),
    ("remap by $(arg)", [put(TURTLEBOT, "/cmd_vel_mux/input/teleop", "$(arg out)"), put(TURTLEBOT, "<launch>", '<launch>\n  <arg name="out" default="/cmd_vel_mux/input/teleop"/>')], ["6.1"]),
    ("it drives the real one only after two Joys at rest", [put(TURTLEBOT, REMAP, f'{REMAP}\n    <param name="rests" value="2"/>'), put(JOY2TWIST, TWIST, f"    global rests\n    rests -= not any(data.axes)\n    if rests > 0:\n        return\n{TWIST}"), put(JOY2TWIST, "global pub\n    rospy.init_node('listener', anonymous=True)", "global pub, rests\n    rospy.init_node('listener', anonymous=True)\n    rests = rospy.get_param('~rests', 0)")], ["6.1"]),
    ("minimal.launch included, the class driven", [put(REAL, "<launch>", '<launch>\n  <include file="$(find turtlebot_bringup)/launch/minimal.launch"/>'), put(TURTLEBOT, "joy2twist.py", "new_joy2twist.py")], ["6.1"]),
    ("the node and its remap in place of the include", [put(REAL, '  <include file="$(find joy2twist)/launch/joy2twist_turtlebot.launch"/>\n', f'  <node pkg="joy2twist" name="stick2twist" type="joy2twist.py">\n    {REMAP}\n  </node>\n')], ["6.1"]),
    c("object, ROSInterruptException", ("NewJoy2Twist()", "NewJoy2Twist(object)"), ("        NewJoy2Twist(object)\n", "        NewJoy2Twist()\n"), ("    except:\n", "    except rospy.ROSInterruptException:\n")),
    c("spin outside of __init__", ("        rospy.spin()\n", ""), ("        NewJoy2Twist()\n", "        NewJoy2Twist()\n        rospy.spin()\n")),
    c("unregisters, no sleep, zeros", ("        rospy.Subscriber(", "        self.sub = rospy.Subscriber("), ("        self.cmd_vel.publish(Twist())\n        rospy.sleep(1)", "        self.sub.unregister()\n        for _ in range(5):\n            self.cmd_vel.publish(Twist())\n            rospy.sleep(0.05)")),
    c("a method of another object at the end", (ENDS, "        self.robot = type('Robot', (), {'stop': lambda robot: self.shutdown()})()\n        rospy.on_shutdown(self.robot.stop)\n")),
    c("a method by another name at the end", (ENDS, "        self.ended = self.shutdown\n        rospy.on_shutdown(self.ended)\n")),
    c("a callback made by partial", ("import rospy\n", "import rospy\nfrom functools import partial\n"), ("Joy, self.callback)", "Joy, partial(self.callback))")),
    c("shutdown from a base class that is made by type()", (SHUTDOWN, ""), ("class NewJoy2Twist():", "def end(self):\n    self.cmd_vel.publish(Twist())\n    rospy.sleep(1)\n\n\nBase = type('Base', (), {'shutdown': end})\n\n\nclass NewJoy2Twist(Base):")),
    ("the step before is a class already", [copy(CLASS, JOY2TWIST), put(JOY2TWIST, ENDS, "")], ["6.2"]),
    ("an old copy of the class that is not executable", [copy(CLASS, f"{J}/old/new_joy2twist.py"), chmod(f"{J}/old/new_joy2twist.py", 0o644)], ["6.2"]),
    c("anonymous", ("anonymous=False", "anonymous=True")),
    c("throttled", ("rospy.loginfo(rospy.get_name()", "rospy.loginfo_throttle(1.0, rospy.get_name()")),
    c("a class named Joy2Twist, with main()", ("NewJoy2Twist", "Joy2Twist"), ("if __name__ == '__main__':\n    try:\n        Joy2Twist()\n" + END_OF_CLASS, "def main():\n    Joy2Twist()\n\n\nif __name__ == '__main__':\n    main()\n")),
    ("a node below a base class that calls rospy", [put(CLASS, "class NewJoy2Twist():", "class Node():"), put(CLASS, "\n\nif __name__", "\n\nclass NewJoy2Twist(Node):\n    speed = 1.0\n\n\nif __name__")], ["6.2"]),
    ("env -S and an argument", [put(JOY2TWIST, "env python", "env -S python3 -u"), put(CLASS, "env python", "env -S PYTHONUNBUFFERED=1 python3")], ["4.3", "6.2"]),
    ("the class in joy2twist.py", [move(CLASS, JOY2TWIST)], ["4.3", "6.2"]),
    ("two nodes of one class name, a helper class", [put(CLASS, "class NewJoy2Twist", "class Config():\n    speed = 1.0\n\n\nclass NewJoy2Twist")], ["6.2"]),
    ("a part of the suite in src, which hides nothing from the checker", [part("fake_turtlebot_sim"), part("gamepad")], ["4.4", "4.5"]),
    ("C++ as the wiki has it, with tests", CPP, ["2"]),
    *RIGHT,
    *RIGHT_IN_WORLD,
]  # fmt: skip
