"""Mistakes with packages and files, each a row: (exercise, what, edits, check, word of the diagnosis)."""

from edits import (
    JOY2TWIST,
    LISTENER,
    TALKER,
    B,
    J,
    chmod,
    copy,
    lines,
    move,
    put,
    remove,
    windows,
    write,
)

PUT_XML, PUT_JOY_XML = f"{B}/package.xml", f"{J}/package.xml"


def manifest(format_, depends):
    """A package.xml of so many lines, with dependencies in the sixth."""
    return f"""<package {format_}>
<name>{B}</name><version>0.0.0</version>
<description>x</description>
<maintainer email="s@u.example">s</maintainer>
<license>x</license>
{depends}
</package>
"""


ROWS = [
    ("2", "package beside src", [move(B, f"../{B}")], "C2", "beside src"),
    ("2", "no package", [move(B, "../../gone")], "C2", "none; found"),
    ("2", "upper case in the name", [put(PUT_XML, f"<name>{B}<", "<name>Beginner_Tutorials<")], "C2", "exactly"),
    ("2", "hyphen in the name", [put(PUT_XML, f"<name>{B}<", "<name>beginner-tutorials<")], "C2", "exactly"),
    ("2", "misspelt name", [put(PUT_XML, f"<name>{B}<", "<name>beginer_tutorials<")], "C2", "exactly"),
    ("2", "two packages of the name", [copy(PUT_XML, "old/package.xml")], "C2", "2: "),
    ("2", "within another package", [move(B, f"{J}/{B}")], "C2", "within another"),
    ("2", "broken package.xml", [put(PUT_XML, "</description>", "</describtion>")], "C2", "mismatched tag"),
    ("2", "package.xml cut off", [put(PUT_XML, "</package>", "")], "C2", "no element found"),
    ("2", "run_depend in format 2", [write(PUT_XML, manifest("format='2'", "<run_depend>rospy</run_depend>"))], "C2", (f"{B}/package.xml:6", "write exec_depend")),
    ("2", "exec_depend in format 1", [write(PUT_XML, manifest("", "<exec_depend>rospy</exec_depend>"))], "C2", (f"{B}/package.xml:6", "write <package format")),
    ("2", "no license", [write(PUT_XML, manifest("format='2'", "").replace("<license>x</license>", ""))], "C2", ('one "license" tag', "catkin wants what is named")),
    ("2", "a format yet to come", [write(PUT_XML, manifest("format='4'", ""))], "C2", (f"{B}/package.xml:1", "write <package format")),
    ("2", "a condition with one =", [write(PUT_XML, manifest("format='3'", "<depend condition='$ROS_VERSION = 1'>rospy</depend>"))], "C2", (f"{B}/package.xml:6", "by two =")),
    ("2", "run_depend in a folder of another name", [move(B, "mine"), write("mine/package.xml", manifest("format='2'", "<run_depend>rospy</run_depend>"))], "C2", ("mine/package.xml:6", "write exec_depend")),
    ("2", "roscpp forgotten", [put(PUT_XML, "roscpp", "rospy")], "C3", "roscpp"),
    ("2", "std_msg", [put(PUT_XML, "std_msgs", "std_msg")], "C3", "std_msg"),
    ("2", "commas in package.xml", [put(PUT_XML, "<build_depend>rospy<", "<build_depend>rospy,<")], "C3", "comma"),
    ("2", "commas in CMakeLists.txt", [put(f"{B}/CMakeLists.txt", "std_msgs rospy", "std_msgs, rospy,")], "C4", "comma"),
    ("2", "CMakeLists.txt broken", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package(")], "C4", "CMakeLists"),
    ("2", "CMakeLists.txt missing", [remove(f"{B}/CMakeLists.txt")], "C4", "CMakeLists"),
    ("2", "unknown component", [put(f"{B}/CMakeLists.txt", "roscpp", "roscpp_tutorial_x")], "C4", "roscpp_tutorial_x"),
    ("2", "rosccp in package.xml", [put(PUT_XML, "roscpp", "rosccp")], "C3", (f"{B}/package.xml:11", "correct rosccp to roscpp")),
    ("2", "the place of a dependency", [lines(PUT_XML, 11, 14)], "C3", (f"{B}/package.xml:11", "add <depend>roscpp")),
    ("2", "rospcc in CMakeLists.txt", [put(f"{B}/CMakeLists.txt", "roscpp", "rospcc")], "C4", (f"{B}/CMakeLists.txt:4", "correct rospcc to roscpp")),
    ("2", "an empty devel/setup.bash", [write("../devel/setup.bash", "")], "C1", "rm -r build devel"),
    ("2", "a part of the suite in src", [copy(PUT_XML, "sim/package.xml"), put("sim/package.xml", f"<name>{B}<", "<name>fake_turtlebot_sim<")], "C1", ("where:    src/sim", "remove it from src")),
    ("2", "catkin_create_pkg without a name", [move(B, "std_msgs"), put("std_msgs/package.xml", f"<name>{B}<", "<name>std_msgs<")], "C1", ("src/std_msgs", "first word is the name")),
    ("3", "no talker.py", [remove(TALKER)], "C5", "no such file"),
    ("3", "talker.py misnamed", [move(TALKER, f"{B}/scripts/Talker.py")], "C5", "Talker.py"),
    ("3", "chmod forgotten", [chmod(TALKER, 0o644)], "C5", "chmod +x"),
    ("3", "Windows line ends", [windows(LISTENER)], "C5", "Windows line ends"),
    ("3", "no shebang", [lines(LISTENER, 1)], "C5", "first line"),
    ("3", "shebang in line 2", [put(TALKER, "#!/usr", "\n#!/usr")], "C5", "further down"),
    ("3", "shebang of nothing", [put(TALKER, "env python", "env pyton")], "C5", "interpreter"),
    ("3", "shebang of Python 2", [put(TALKER, "env python", "env python2")], "C5", "env python3"),
    ("3", "byte order mark", [put(TALKER, "#!/usr", "\ufeff#!/usr")], "C5", "byte order mark"),
    ("3", "an empty file", [write(TALKER, "")], "C5", "empty"),
    ("3", "a web page", [write(TALKER, "<!DOCTYPE html>\n<html></html>\n")], "C5", "web page"),
    ("3", "underscore lost: std msgs", [put(TALKER, "std_msgs", "std msgs")], "C5", "underscores"),
    ("3", "underscore lost: init node", [put(LISTENER, "init_node", "init node")], "C5", "underscores"),
    ("3", "underscore lost: queue size", [put(TALKER, "queue_size", "queue size")], "C5", "underscores"),
    ("3", "Python 2's print", [put(LISTENER, 'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)', "print data.data")], "C5", "parentheses"),
    ("3", "curly quotes", [put(TALKER, "'chatter'", "‘chatter’")], "C5", "curly quotes"),
    ("3", "colon forgotten", [put(LISTENER, "def listener():", "def listener()")], "C5", "ends with :"),
    ("3", "indentation", [put(TALKER, "    rate = ", "   rate = ")], "C5", "indent"),
    ("3", "bracket not closed", [put(LISTENER, "callback)", "callback")], "C5", "bracket"),
    ("3", "a second listener.py", [copy(LISTENER, f"{B}/src/listener.py")], "C5", "non-unique"),
    ("3", "std_msgs misspelt", [put(TALKER, "from std_msgs.msg", "from std_msg.msg")], "C6", "std_msgs.msg"),
    ("3", "string in lower case", [put(TALKER, "import String", "import string")], "C6", "capitals"),
    ("3", "another topic", [put(TALKER, "'chatter'", "'chater'")], "C6", "/chater"),
    ("3", "init_node forgotten", [lines(TALKER, 8)], "C6", "init_node"),
    ("3", "talker() not called", [put(TALKER, "        talker()\n", "        pass\n")], "C6", "talker()"),
    ("3", "no loop", [put(TALKER, "while not", "if not")], "C6", "while not"),
    ("3", "sleep forgotten", [put(TALKER, "        rate.sleep()\n", "")], "C6", "rate.sleep"),
    ("3", "publish forgotten", [put(TALKER, "        pub.publish(words)\n", "")], "C6", "publish"),
    ("3", "Twist for String", [put(TALKER, "from std_msgs.msg import String", "from geometry_msgs.msg import Twist as String"), put(TALKER, "publish(words)", "publish(String())")], "C6", "Twist"),
    ("3", "listener on another topic", [put(LISTENER, '"chatter"', '"/chat"')], "C7", "/chat"),
    ("3", "spin without ()", [put(LISTENER, "rospy.spin()", "rospy.spin")], "C7", "()"),
    ("3", "spin forgotten", [put(LISTENER, "    rospy.spin()\n", "")], "C7", "spin"),
    ("3", "listener() not called", [put(LISTENER, "__main__':\n    listener()", "__main__':\n    pass")], "C7", "listener()"),
    ("3", "data for data.data", [put(LISTENER, "data.data", "dat.data")], "C7", "dat"),
    ("3", "callback()", [put(LISTENER, "String, callback)", "String, callback())")], "C7", "without ()"),
    ("3", "the listener displays nothing", [put(LISTENER, 'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)', "pass")], "C7", "display"),
    ("3", "ends not on Ctrl-C", [put(TALKER, "while not rospy.is_shutdown():", "import signal\n    signal.signal(signal.SIGINT, signal.SIG_IGN)\n    while True:")], "C10", "killed"),
    ("3", "gaps in the line of main", [put(TALKER, "__name__ == '__main__'", "name == ' main '")], "C5", ("talker.py:17", "if __name__ == '__main__':")),
    ("3", "Windows line ends, seen oneself", [windows(LISTENER)], "C5", ("listener.py:1", "yourself: head -1 scripts/listener.py")),
    ("3", "listener.py without #!, seen oneself", [lines(LISTENER, 1)], "C5", "yourself: head -3 scripts/listener.py"),
    ("3", "listener.py not executable, seen oneself", [chmod(LISTENER, 0o644)], "C5", "yourself: ls -l scripts/listener.py"),
    ("3", "no listener.py", [remove(LISTENER)], "C5", "create scripts/listener.py"),
    ("3", "the loop without sleep", [put(TALKER, "        rate.sleep()\n", "")], "C6", ("talker.py:10", "a second")),
    ("4.3", "dependency forgotten", [put(PUT_JOY_XML, "sensor_msgs", "rospy")], "C12", "sensor_msgs"),
    ("4.3", "broken package.xml of the other package", [put(PUT_XML, "</description>", "</describtion>")], "C14", ("beginner_tutorials/package.xml:5", "no node of the workspace starts")),
    ("5", "broken package.xml beside the launch files", [put(PUT_XML, "</description>", "</describtion>")], "C21", ("beginner_tutorials/package.xml:5", "no node of the workspace starts")),
    ("4.3", "no package joy2twist", [put(PUT_JOY_XML, "<name>joy2twist<", "<name>joy-2-twist<")], "C12", "exactly"),
    ("4.3", "misspelt program", [move(JOY2TWIST, f"{J}/scripts/Joy2Twist.py")], "C13", "Joy2Twist.py"),
    ("4.3", "chmod forgotten", [chmod(JOY2TWIST, 0o644)], "C13", "chmod"),
    ("4.3", "load_manifest of another name", [put(JOY2TWIST, "load_manifest('joy2twist')", "load_manifest('joy2twst')")], "C13", "joy2twst"),
    ("4.3", "sensor msgs", [put(JOY2TWIST, "sensor_msgs.msg", "sensor msgs.msg")], "C13", "underscores"),
]  # fmt: skip
