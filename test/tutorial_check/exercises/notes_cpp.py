"""Right talkers and listeners in C++ that deserve a note, or none."""

from edits import put, remove, write
from mistakes_cpp_talker import INFO
from rows import noted
from solution import TALKER as TALKER_PY
from solution import B
from solution_cpp import JOY2TWIST, LISTENER, PUB, SHOW, TALKER

PYTHON = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
rospy.init_node('talker', anonymous=True)
pub = rospy.Publisher('chatter', String, queue_size=10)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    pub.publish('good day at %s' % rospy.get_time())
    rate.sleep()
"""
INIT = 'ros::init(argc, argv, "talker", ros::init_options::AnonymousName);'
COUT = 'std::cout << "heard " << message->data'
IOSTREAM = put(LISTENER, "#include <ros/ros.h>", "#include <iostream>\n&")
NOTES = [
    noted("plain C++", "3", [], C5=["src/talker.cpp, src/listener.cpp: in C++", "right"]),
    noted("no text in the message", "3", [put(TALKER, "    message.data = text.str();\n", "")],
        C6=["always the same text, ''"]),
    noted("a text without std::endl", "3", [IOSTREAM, put(LISTENER, INFO, f"{COUT};")],
        C7=["ends no line", "listener.cpp:7", "std::endl"]),
    noted("a text with std::endl", "3", [IOSTREAM, put(LISTENER, INFO, f"{COUT} << std::endl;")],
        C7=()),
    noted("remaps in the code", "3", [put(TALKER, INIT, 'ros::M_string remaps;\n'
        '  remaps["words"] = "chatter";\n'
        '  ros::init(remaps, "talker", ros::init_options::AnonymousName);'),
        put(TALKER, '>("chatter"', '>("words"')], C8=(), C9=["talker.cpp:10", "ignores __name:="]),
    noted("spin in the callback", "3", [put(LISTENER, INFO, f"{INFO}\n  ros::spin();")],
        C7=["ros::spin() in the callback", "listener.cpp:7"]),
    noted("a talker in Python, a listener in C++", "3", [remove(TALKER), write(TALKER_PY, PYTHON),
        put(f"{B}/CMakeLists.txt", "add_executable(talker src/talker.cpp)\n"
            "target_link_libraries(talker ${catkin_LIBRARIES})\n", "")],
        C5=["src/listener.cpp: in C++"], C9=()),
    noted("queues of 0 and 1", "3", [put(TALKER, '"chatter", 10', '"chatter", 0'),
        put(LISTENER, '"chatter", 10', '"chatter", 1')], C6=(), C7=()),
    noted("a latch in C++", "4.3", [put(JOY2TWIST, 'Twist>("/cmd_vel", 10', "&, true")],
        C16=["latch, the true of advertise", "leave latch out"]),
    noted("six axes or none", "4.5", [put(JOY2TWIST, SHOW,
        f'  if (joy->axes.size() != 6) throw std::runtime_error("six");\n{SHOW}')],
        C20=["eight axes", "for (float axis : msg->axes)"]),
    noted("an AsyncSpinner before the Publisher", "4.3", [put(JOY2TWIST, f"  {PUB}\n", ""),
        put(JOY2TWIST, "  ros::spin();\n", "  ros::AsyncSpinner spinner(1);\n  spinner.start();\n"
            f"  {PUB}\n  ros::waitForShutdown();\n")],
        C18=["joy2twist.cpp:22", "there is no pub", "first the Publisher"]),
]  # fmt: skip
