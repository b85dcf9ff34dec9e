"""Right solutions worth a note: {check: words of its note}; no words mean no note."""

from edits import built, chatter, chmod, put, remove, write
from manifests import package
from rows import noted
from solution import CLASS, CMAKE, JOY2TWIST, JOY_BAG, LAUNCH_BAG, LISTENER, SUB, TALKER, B

LATE = "def made():\n    rospy.sleep(0.5)\n    return rospy.Publisher('/cmd_vel', Twist)\n\n\n"
PUB = "pub = rospy.Publisher('/cmd_vel', Twist)"
HEARD = 'I heard %s", data.data)'
INSTALL = (
    "catkin_install_python(PROGRAMS scripts/talker.py scripts/listener.py "
    "DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"
)
LACKS = "find_package(catkin REQUIRED COMPONENTS diagnostic_nowhere)\ncatkin_package()"
FAILS = "find_package(catkin REQUIRED)\ncatkin_package()\nadd_executable(joy_node x.cpp)"
MAKES = (
    "find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)\n"
    "add_message_files(FILES Mine.msg)\n"
    "generate_messages(DEPENDENCIES std_msgs)\ncatkin_package()"
)
ENDS = "        rospy.on_shutdown(self.shutdown)\n"
PUBLISHER = "        self.cmd_vel = rospy.Publisher('/cmd_vel', Twist)\n"
NOTES = [
    noted("a gap in a node's name", "5", [put(LAUNCH_BAG, "my_rviz", "my rviz")],
        C22=("launch_bag.launch:2", 'name="my_rviz"')),
    noted("half as often, displayed twice, called like its file", "3",
        [put(TALKER, "Rate(10)", "Rate(5)"), put(TALKER, "'talker'", "'talker.py'"),
        put(LISTENER, HEARD, "&\n    print(data.data)")], C5=("talker.py:8", "only: 'talker'"),
        C6=("the handout's is 10",), C7=("listener.py:8", "displayed 2 times")),
    noted("two Subscribers", "3", [put(LISTENER, "    rospy.spin()",
        '    rospy.Subscriber("chatter", String, callback)\n    rospy.spin()')], C6=(),
        C7=("listener.py:13", "displayed 2 times")),
    noted("half as fast, called like its file", "4.3",
        [put(JOY2TWIST, "= data.axes[1]", "= 0.5*data.axes[1]"),
        put(JOY2TWIST, "'listener'", "'joy2twist.py'")],
        C13=("joy2twist.py:18", "only: 'joy2twist'"), C16=("linear.x = 0.50 * axes[1]",)),
    noted("loginfo_throttle", "4.3", [put(JOY2TWIST, "rospy.loginfo(",
        "rospy.loginfo_throttle(1.0, ")], C14=("now and then", "joy2twist.py:9")),
    noted("two curves, the publisher first", "4.3", [put(JOY2TWIST, "= data.axes[1]", "& ** 3"),
        put(JOY2TWIST, "= data.axes[0]", "& ** 3"),
        put(JOY2TWIST, f"{SUB}\n    {PUB}", f"{PUB}\n    {SUB}")],
        C16=("are curves of their axes",), C18=()),
    noted("the publisher made late, by a function above", "4.3",
        [put(JOY2TWIST, PUB, "pub = made()"), put(JOY2TWIST, "def listener", f"{LATE}&")],
        C18=("joy2twist.py:24", "there is no pub")),
    noted("two Twists for a Joy", "4.3", [put(JOY2TWIST, "pub.publish(msg)",
        "&\n    pub.publish(msg)")], C16=("joy2twist.py:14", "2 Twists for each Joy",
        "one is enough")),
    noted("a latch", "4.3", [put(JOY2TWIST, "'/cmd_vel', Twist", "&, latch=True")],
        C16=("latch=True", "leave latch out")),
        noted("the real joy, which cannot be built here, and scripts that catkin_install_python "
        "makes runnable", "2 3 5", [*package("joy", LACKS), chmod(TALKER, 0o644),
        chmod(LISTENER, 0o644), put(CMAKE, "catkin_package()", f"&\n{INSTALL}")],
        C1=("never built",), C4=("joy/CMakeLists.txt:3",
        "another package fails: catkin cannot find diagnostic_nowhere", "CATKIN_IGNORE"), C5=(),
        C25=()),
    noted("the real joy, whose header is not here", "2 5", [*package("joy", FAILS),
        write("joy/x.cpp", "#include <nowhere.h>\n")], C4=("another package fails:", "nowhere.h"),
        C26=()),
    noted("the real kobuki_msgs", "2", [*package("kobuki_msgs", MAKES),
        write("kobuki_msgs/msg/Mine.msg", "uint8 x\n")], C1=("never built",), C4=()),
    noted("a package of CMake alone", "2", package("plain", "", "1",
        "<export><build_type>cmake</build_type></export>"),
        C4=("another package fails: CMake: This workspace contains non-catkin packages in it, "
        "and",)),
    noted("a recording of another topic", "4.2", [remove(JOY_BAG), chatter(f"{B}/chatter.bag")],
        C11=(f"{B}/chatter.bag", "no recording of /joy; topics: /chatter")),
    noted("a devel folder from another home, in parts", "2",
        [built("/nowhere", home="/home/ada/ws"), remove("../devel/_setup_util.py")],
        C1=("made elsewhere (/home/ada/ws/devel)",)),
    noted("built over a ROS in /opt/ros", "2", [built("/opt/ros/noetic")],
        C1=("built over /opt/ros/noetic alone",)),
    noted("a devel folder from which git has left out setup.*", "2",
        [built("/home/ada/ws/devel;/opt/ros/noetic"), remove("../devel/setup.sh"),
        remove("../devel/setup.bash")],
        C1=("has no setup.bash; built again here", "rm -r build devel"), C4=()),
    noted("an except that reports, the publisher first", "6.2",
        [put(CLASS, ENDS + PUBLISHER, PUBLISHER + ENDS), put(CLASS, "    except:\n",
        "    except Exception as error:\n"),
        put(CLASS, '"The node has ended."', 'f"Error: {error}"')], C29=(), C33=()),
]  # fmt: skip
