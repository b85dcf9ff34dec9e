"""Mistakes with packages, files, talker and listener: (exercise, what, edits, check, word or words)."""

from edits import *

CMAKE = f"{B}/CMakeLists.txt"
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


def cpp(text, cmake="", link="target_link_libraries(use ${catkin_LIBRARIES})"):
    """A program in C++, use, and what CMakeLists.txt says of it."""
    add = f"catkin_package()\nadd_executable(use src/use.cpp)\n{link}\n{cmake}"
    return [write(f"{B}/src/use.cpp", text), put(CMAKE, "catkin_package()", add)]


SPINS = '#include <ros/ros.h>\nint main(int n, char** words) {\n  ros::init(n, words, "use");\n  ros::spin();\n}\n'
MAKES = [
    write(f"{B}/msg/Num.msg", "int64 num\n"),
    put(
        CMAKE,
        "roscpp)",
        "roscpp message_generation)\nadd_message_files(FILES Num.msg)\ngenerate_messages(DEPENDENCIES std_msgs)",
    ),
]
USES = f'#include "{B}/Num.h"\nint main() {{ return {B}::Num().num; }}\n'
ROSEUS = [
    write("arm/package.xml", manifest("format='2'", "").replace(B, "arm")),
    write(
        "arm/CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.5)\nproject(arm)\nfind_package(catkin REQUIRED COMPONENTS roseus)\ncatkin_package()\n",
    ),
]
FORMAT_1 = "".join(
    f"<build_depend>{each}</build_depend><run_depend>{each}</run_depend>"
    for each in ("rospy", "std_msgs")
)
ROWS = [
    ("2", "package beside src", [move(B, f"../{B}")], "C2", ("beside src", "hint:     mv /", f"/{B} /")),
    ("2", "a link that leads nowhere", [move(B, "../../gone"), lambda src: (src / B).symlink_to("/nowhere")], "C2", ("a link to /nowhere, and leads nowhere here", "put the folder itself")),
    ("2", "no package", [move(B, "../../gone")], "C2", ("none; found", "has one of OURS")),
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
    ("2", "roscpp forgotten in format 1", [write(PUT_XML, manifest("", "<buildtool_depend>catkin</buildtool_depend>" + FORMAT_1))], "C3", ("hint:     add <build_depend>roscpp</build_depend> and <run_depend>roscpp</run_depend>", f"{B}/package.xml:6")),
    ("2", "<depend> in format 1", [write(PUT_XML, manifest("", f"{FORMAT_1}<depend>roscpp</depend>"))], "C2", (f"{B}/package.xml:6", "or build_depend and run_depend")),
    ("2", "std_msg in build_depend alone", [put(PUT_XML, "<build_depend>std_msgs<", "<build_depend>std_msg<")], "C3", ("package.xml:9", "std_msg, which is no package", "correct std_msg to std_msgs")),
    ("2", "two dependencies forgotten", [put(PUT_XML, "  <build_depend>rospy</build_depend>\n  <build_depend>roscpp</build_depend>\n", ""), put(PUT_XML, "  <exec_depend>rospy</exec_depend>\n  <exec_depend>roscpp</exec_depend>\n", "")], "C3", ("<depend>rospy</depend>", "<depend>roscpp</depend>")),
    ("2", "commas in package.xml", [put(PUT_XML, "<build_depend>rospy<", "<build_depend>rospy,<")], "C3", "comma"),
    ("2", "commas in CMakeLists.txt", [put(f"{B}/CMakeLists.txt", "std_msgs rospy", "std_msgs, rospy,")], "C4", "comma"),
    ("3", "Int32 for String", [put(TALKER, "String", "Int32")], "C6", ("talker.py:7", "from std_msgs.msg import String")),
    ("3", "a number published", [put(TALKER, "pub.publish(words)", "pub.publish(5)")], "C6", ("talker.py:13", "text")),
    ("3", "Int32 in the listener", [put(LISTENER, "String", "Int32")], "C7", ("listener.py:12", "wants Int32", "at the top: from std_msgs.msg import String")),
    ("2", "CMakeLists.txt broken", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package(")], "C4", "CMakeLists"),
    ("2", "another name in CMakeLists.txt", [put(f"{B}/CMakeLists.txt", f"project({B})", "project(beginner-tutorials)")], "C4", ("PROJECT_NAME 'beginner-tutorials'", f"{B}/CMakeLists.txt:", "into project()")),
    ("2", "a program to install that there is not", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package()\ncatkin_install_python(PROGRAMS scripts/taker.py DESTINATION x)")], "C4", (f"{B}/CMakeLists.txt:7", "non-existing file", "spelling of the file's path")),
    ("2", "a source file that there is not", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package()\nadd_executable(talker src/talker.cpp)")], "C4", (f"{B}/CMakeLists.txt:7", "CMake: Cannot find source file: src/talker.cpp", "spelling of the file's path")),
    ("2", "an include folder that git has lost", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package(INCLUDE_DIRS include)")], "C4", (f"{B}/CMakeLists.txt:6", "include dir 'include' does not exist", "keeps no empty folders: put a file into include,")),
    ("2", "a msg folder that git has lost", [put(f"{B}/CMakeLists.txt", "catkin_package()", "find_package(message_generation REQUIRED)\nadd_message_files()\ncatkin_package()")], "C4", (f"{B}/CMakeLists.txt:7", f"put a file into {B}/msg,")),
    ("2", "a subfolder that git has lost", [put(f"{B}/CMakeLists.txt", "catkin_package()", "catkin_package()\nadd_subdirectory(nodes)")], "C4", (f"{B}/CMakeLists.txt:7", "put a file into nodes,")),
    ("2", "message_generation not named", [put(f"{B}/CMakeLists.txt", "catkin_package()", "add_service_files(FILES Go.srv)\ncatkin_package()")], "C4", (f"{B}/CMakeLists.txt:6", "add_service_files() is of message_generation")),
    ("2", "CMakeLists.txt missing", [remove(f"{B}/CMakeLists.txt")], "C4", "CMakeLists"),
    ("2", "CMakeLists.txt is a folder", [remove(f"{B}/CMakeLists.txt"), write(f"{B}/CMakeLists.txt/CMakeLists.txt", "")], "C4", "CMakeLists"),
    ("3", "another topic, and CMakeLists.txt is a folder", [remove(f"{B}/CMakeLists.txt"), write(f"{B}/CMakeLists.txt/CMakeLists.txt", ""), put(TALKER, "'chatter'", "'chater'")], "C6", "/chater"),
    ("2", "unknown component", [put(f"{B}/CMakeLists.txt", "roscpp", "roscpp_tutorial_x")], "C4", "roscpp_tutorial_x"),
    ("2", "rosccp in package.xml", [put(PUT_XML, "roscpp", "rosccp")], "C3", (f"{B}/package.xml:11", "correct rosccp to roscpp")),
    ("2", "the place of a dependency", [lines(PUT_XML, 11, 14)], "C3", (f"{B}/package.xml:11", "add <depend>roscpp")),
    ("2", "a package that Debian has, not installed", [put(f"{B}/CMakeLists.txt", "roscpp", "roscpp stereo_image_proc")], "C4", (f"{B}/CMakeLists.txt:4", "apt install libstereo-image-proc-dev")),
    ("2", "rospcc in CMakeLists.txt", [put(f"{B}/CMakeLists.txt", "roscpp", "rospcc")], "C4", (f"{B}/CMakeLists.txt:4", "correct rospcc to roscpp")),
    ("2", "a real package that Debian lacks", [put(CMAKE, "roscpp", "roscpp control_msgs")], "C4", (f"{CMAKE}:4", "catkin cannot find control_msgs", "Debian lacks control_msgs; its sources, cloned into src")),
    ("2", "a header that is made too late", [*MAKES, *cpp(USES)], "C4", (f"{B}/src/use.cpp:1", f"seen:     {B}/Num.h: No such file", "hint:     use is compiled before its header is made of Num.msg", "add_dependencies(use ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})")),
    ("2", "a header of which nothing is made", [MAKES[0], *cpp(USES)], "C4", (f"{B}/src/use.cpp:1", "no header is made of Num.msg: CMakeLists.txt lacks add_message_files and generate_messages")),
    ("2", "a dependency target that there is not", cpp(SPINS, f"add_dependencies(use {B}_gencpp)"), "C4", (f"{CMAKE}:9", f"nothing makes {B}_gencpp: add_dependencies(use ${{${{PROJECT_NAME}}_EXPORTED")),
    ("2", "no libraries linked", cpp(SPINS, link=""), "C4", (f"{CMAKE}:7", "use: undefined reference to `ros::init", "write target_link_libraries(use ${catkin_LIBRARIES})")),
    ("2", "a .cpp file that is not named", cpp("int other();\nint main() { return other(); }\n"), "C4", (f"{CMAKE}:7", "use: undefined reference to `other()'", "the .cpp file that has it belongs into add_executable")),
    ("2", "a folder include that is not named", [*cpp(f"#include <{B}/own.h>\nint main() {{}}\n"), write(f"{B}/include/{B}/own.h", "")], "C4", (f"{B}/src/use.cpp:1", "include_directories(include ${catkin_INCLUDE_DIRS})")),
    ("2", "an error of one's own, and one of another package", [*cpp("int main() { return zero; }\n"), *ROSEUS], "C4", (f"where:    {B}/src/use.cpp:1", "was not declared in this scope; another package fails, too: catkin cannot find roseus (arm/CMakeLists.txt:3)", "hint:     zero is not known there")),
    ("2", "an empty devel/setup.bash", [write("../devel/setup.bash", "")], "C1", "rm -r build devel"),
    ("2", "built over another copy of the suite", [built("/mine/devel;/other/lower/devel")], "C1", "another copy of the suite, /other/lower/devel;"),
    ("2", "built over ROS alone", [built("/usr")], "C1", ("built over /usr", "without ./tutorial shell")),
    ("2", "a whole devel, but for setup.bash", [built("/opt/ros/one", **{"setup.bash": ""})], "C1", ("not whole: setup.bash", "rm -r build devel, then catkin_make")),
    ("2", "a whole devel, but for _setup_util.py", [built("/opt/ros/one"), remove("../devel/_setup_util.py")], "C1", ("not whole: _setup_util.py", "rm -r build devel")),
    ("2", "a part of the suite in src", [copy(PUT_XML, "sim/package.xml"), put("sim/package.xml", f"<name>{B}<", "<name>fake_turtlebot_sim<")], "C1", ("where:    src/sim", "remove it from src")),
    ("2", "catkin_create_pkg without a name", [move(B, "std_msgs"), put("std_msgs/package.xml", f"<name>{B}<", "<name>std_msgs<")], "C1", ("src/std_msgs", "first word is the name")),
    ("3", "talker.py misnamed", [move(TALKER, f"{B}/scripts/Talker.py")], "C5", "Talker.py"),
    ("3", "shebang in line 2", [put(TALKER, "#!/usr", "\n#!/usr")], "C5", "further down"),
    ("3", "shebang of nothing", [put(TALKER, "env python", "env pyton")], "C5", "interpreter"),
    ("3", "env -S of nothing", [put(TALKER, "env python", "env -S pythn3 -u")], "C5", ("talker.py:1", "an interpreter that exists")),
    ("3", "shebang of a shell", [put(TALKER, "/usr/bin/env python", "/bin/sh")], "C5", ("talker.py:1", "an interpreter that exists")),
    ("3", "shebang of Python 2", [put(TALKER, "env python", "env python2")], "C5", "env python3"),
    ("3", "byte order mark", [put(TALKER, "#!/usr", "\ufeff#!/usr")], "C5", "byte order mark"),
    ("3", "an empty file", [write(TALKER, "")], "C5", "empty"),
    ("3", "a web page", [write(TALKER, "<!DOCTYPE html>\n<html></html>\n")], "C5", "web page"),
    ("3", "Latin-1", [latin1(TALKER, "import rospy\n", "# by Jörg")], "C5", ("talker.py:3", "save the file as UTF-8")),
    ("3", "a coding that is none", [latin1(LISTENER, "#!/usr/bin/env python\n", "# coding: utf-88")], "C5", ("listener.py:2", "utf-88")),
    ("3", "underscore lost: init node", [put(LISTENER, "init_node", "init node")], "C5", "underscores"),
    ("3", "underscore lost: queue size", [put(TALKER, "queue_size", "queue size")], "C5", "underscores"),
    ("3", "Python 2's print", [put(LISTENER, 'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)', "print data.data")], "C5", ("parentheses", "this is Python 2: 2to3 -w /", "-m fissix -w /", f"src/{LISTENER}")),
    ("3", "Python 2's except", [put(TALKER, "except rospy.ROSInterruptException:", "except rospy.ROSInterruptException, error:")], "C5", ("talker.py:20", "this is Python 2: 2to3 -w")),
    ("3", "Python 2's modules", [put(TALKER, "import rospy\n", "import rospy\nimport Tkinter, Queue\n")], "C6", ("talker.py:3", "this is Python 2: 2to3 -w", f"src/{TALKER}")),
    ("3", "Python 2's names", [put(LISTENER, "    rospy.spin()", "    for number in xrange(9):\n        rospy.spin()")], "C7", ("listener.py:13", "this is Python 2: 2to3 -w")),
    ("3", "a module that is not installed", [put(TALKER, "import rospy\n", "import rospy\nimport wx\n")], "C6", ("talker.py:3", "sudo apt install python3-wxgtk4.0")),
    ("3", "a module that Debian lacks", [put(TALKER, "import rospy\n", "import rospy\nimport moveit_commander\n")], "C6", ("talker.py:3", "Debian lacks moveit_commander")),
    ("3", "a file of one's own that was not handed in", [put(TALKER, "import rospy\n", "import rospy\nfrom my_tools import words\n")], "C6", ("talker.py:3", "hand in your own file")),
    ("3", "the talker reads the keyboard", [put(TALKER, "words = ", "words = input('text: ') or ")], "C6", ("talker.py:11", "EOFError", "there is no keyboard here")),
    ("3", "the talker waits for a key under an except", [put(TALKER, "words = ", "words = input('text: ') or "), put(TALKER, "except rospy.ROSInterruptException:", "except EOFError:")], "C6", ("talker.py:11", "it ended, exit code 0", "there is no keyboard here")),
    ("3", "another topic and type, and it ends", [put(TALKER, "'chatter'", "'/talk'"), put(TALKER, "String", "Int32"), put(TALKER, "publish(words)", "publish(5)"), put(TALKER, "while not rospy.is_shutdown():", "for number in range(9):")], "C6", ("talker.py:7", "on /talk, of type std_msgs/Int32, and it ends by itself", "'chatter', String", "while not rospy.is_shutdown()")),
    ("3", "another type, and it ends", [put(TALKER, "String", "Int32"), put(TALKER, "publish(words)", "publish(5)"), put(TALKER, "while not rospy.is_shutdown():", "for number in range(9):")], "C6", ("talker.py:7", "/chatter carries std_msgs/Int32, and it ends by itself")),
    ("3", "twenty messages, and it ends", [put(TALKER, "while not rospy.is_shutdown():", "for number in range(20):")], "C6", ("it ended, exit code 0", "while not rospy.is_shutdown()")),
    ("3", "the listener: another topic and type", [put(LISTENER, "String", "Int32"), put(LISTENER, '"chatter"', '"/talk"')], "C7", ("listener.py:12", "subscribes to /talk, of type std_msgs/Int32")),
    ("3", "curly quotes", [put(TALKER, "'chatter'", "‘chatter’")], "C5", "curly quotes"),
    ("3", "colon forgotten", [put(LISTENER, "def listener():", "def listener()")], "C5", "ends with :"),
    ("3", "indentation", [put(TALKER, "    rate = ", "   rate = ")], "C5", "indent"),
    ("3", "bracket not closed", [put(LISTENER, "callback)", "callback")], "C5", "bracket"),
    ("3", "a second listener.py", [copy(LISTENER, f"{B}/src/listener.py")], "C5", "non-unique"),
    ("3", "std_msgs misspelt", [put(TALKER, "from std_msgs.msg", "from std_msg.msg")], "C6", "std_msgs.msg"),
    ("3", "string in lower case", [put(TALKER, "import String", "import string")], "C6", "capitals"),
    ("3", "another topic", [put(TALKER, "'chatter'", "'chater'")], "C6", "/chater"),
    ("3", "init_node forgotten", [lines(TALKER, 8)], "C6", "init_node"),
    ("3", "it works without end, and ignores Ctrl-C", [write(TALKER, "#!/usr/bin/env python3\nimport signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\nwhile True:\n    pass\n")], "C6", "works all the time"),
    ("3", "talker() not called", [put(TALKER, "        talker()\n", "        pass\n")], "C6", "talker()"),
    ("3", "publish forgotten", [put(TALKER, "        pub.publish(words)\n", "")], "C6", "publish"),
    ("3", "Twist for String", [put(TALKER, "from std_msgs.msg import String", "from geometry_msgs.msg import Twist as String"), put(TALKER, "publish(words)", "publish(String())")], "C6", "Twist"),
    ("3", "listener on another topic", [put(LISTENER, '"chatter"', '"/chat"')], "C7", "/chat"),
    ("3", "spin without ()", [put(LISTENER, "rospy.spin()", "rospy.spin")], "C7", "()"),
    ("3", "spin forgotten", [put(LISTENER, "    rospy.spin()\n", "")], "C7", "spin"),
    ("3", "no Subscriber in the listener", [put(LISTENER, '    rospy.Subscriber("chatter", String, callback)\n', "")], "C7", "rospy.Subscriber('chatter', String, callback)"),
    ("3", "no callback given", [put(LISTENER, "String, callback)", "String)")], "C7", "no callback"),
    ("3", "listener() not called", [put(LISTENER, "__main__':\n    listener()", "__main__':\n    pass")], "C7", "listener()"),
    ("3", "main within the listener", [put(LISTENER, "if __name__ == '__main__':\n    listener()", "    if __name__ == '__main__':\n        listener()")], "C7", ("listener.py:16", "it ended, exit code", "within listener()")),
    ("3", "data for data.data", [put(LISTENER, "data.data", "dat.data")], "C7", "dat"),
    ("3", "callback()", [put(LISTENER, "String, callback)", "String, callback())")], "C7", "without ()"),
    ("3", "the listener displays nothing", [put(LISTENER, 'rospy.loginfo(rospy.get_caller_id() + "I heard %s", data.data)', "pass")], "C7", "display"),
    ("3", "loginfo as if it were print", [put(LISTENER, 'rospy.get_caller_id() + "I heard %s", data.data', '"I heard", data.data')], "C7", ("listener.py:7", "one % for each value")),
    ("3", "ends not on Ctrl-C", [put(TALKER, "while not rospy.is_shutdown():", "import signal\n    signal.signal(signal.SIGINT, signal.SIG_IGN)\n    while True:")], "C10", "killed"),
    ("3", "gaps in the line of main", [put(TALKER, "__name__ == '__main__'", "name == ' main '")], "C5", ("talker.py:17", "if __name__ == '__main__':")),
    ("3", "Windows line ends, seen oneself", [windows(LISTENER)], "C5", ("has Windows line ends", "listener.py:1", "yourself: head -1 /", f"src/{LISTENER}")),
    ("3", "listener.py without #!, seen oneself", [lines(LISTENER, 1)], "C5", ("as the first line", "yourself: head -3 /", f"src/{LISTENER}")),
    ("3", "listener.py not executable, seen oneself", [chmod(LISTENER, 0o644)], "C5", ("yourself: ls -l /", f"src/{LISTENER}")),
    ("3", "no listener.py", [remove(LISTENER)], "C5", "create scripts/listener.py"),
    ("3", "sleep forgotten", [put(TALKER, "        rate.sleep()\n", "")], "C6", ("talker.py:10", "a second", "rate.sleep")),
    ("4.3", "an import of what a build would make, which fails", [put(f"{J}/CMakeLists.txt", "catkin_package()", "catkin_python_setup()\ncatkin_package()"), put(JOY2TWIST, "import rospy\n", "import rospy\nimport axes_of_mine\n")], "C14", ("joy2twist.py:4", "catkin_make, which may have to make it, fails")),
    ("4.3", "dependency forgotten", [put(PUT_JOY_XML, "sensor_msgs", "rospy")], "C12", "sensor_msgs"),
    ("4.3", "broken package.xml of the other package", [put(PUT_XML, "</description>", "</describtion>")], "C14", ("beginner_tutorials/package.xml:5", "no node of the workspace starts")),
    ("4.3", "broken package.xml in a hidden folder", [write(".old/package.xml", "<package>")], "C14", (".old/package.xml:1", "no node of the workspace starts")),
    ("5", "broken package.xml beside the launch files", [put(PUT_XML, "</description>", "</describtion>")], "C21", ("beginner_tutorials/package.xml:5", "no node of the workspace starts")),
    ("4.3", "a dependency that there is not, beside another package's", [put(f"{J}/CMakeLists.txt", "geometry_msgs", "geometry_msgs joystick"), *ROSEUS], "C12", (f"{J}/CMakeLists.txt:4", "joystick")),
    ("4.3", "a dependency that there is not", [put(f"{J}/CMakeLists.txt", "geometry_msgs", "geometry_msgs joystick")], "C12", (f"{J}/CMakeLists.txt:4", "joystick")),
    ("4.3", "roscpp for rospy", [put(PUT_JOY_XML, "rospy", "roscpp")], "C12", ("seen:     no rospy, but roscpp\n", "asks for Python, not for C++: add <depend>rospy</depend>")),
    ("4.3", "joy2twist in C++", [move(JOY2TWIST, f"{J}/src/joy2twist.cpp")], "C13", ("src/joy2twist.cpp", "in C++", "asks for Python", "write scripts/joy2twist.py")),
    ("4.3", "no package joy2twist", [put(PUT_JOY_XML, "<name>joy2twist<", "<name>joy-2-twist<")], "C12", "exactly"),
    ("4.3", "chmod forgotten", [chmod(JOY2TWIST, 0o644)], "C13", "chmod"),
    ("4.3", "load_manifest of another name", [put(JOY2TWIST, "load_manifest('joy2twist')", "load_manifest('joy2twst')")], "C13", "joy2twst"),
    ("4.3", "sensor msgs", [put(JOY2TWIST, "sensor_msgs.msg", "sensor msgs.msg")], "C13", "underscores"),
]  # fmt: skip
