"""Mistakes in the class of section 6.2 in C++, and how it ends."""

from edits import put, remove
from rows import mistake, mistake_in
from solution import J
from solution_cpp import CLASS, JOY2TWIST

cls29, cls30, cls31, cls33 = (mistake_in(CLASS, check) for check in ("C29", "C30", "C31", "C33"))
OWN = ", ros::init_options::NoSigintHandler"
MADE = "  NewJoy2Twist node;\n  robot = &node;\n"
INSTALLED = "  signal(SIGINT, onCtrlC);\n"
POINTER = "NewJoy2Twist* robot = nullptr;\n\n"
HANDLER = "void onCtrlC(int)\n{\n  robot->stop();\n  ros::shutdown();\n}\n\n"
SUBSCRIBED = 'joy_ = node_.subscribe("/joy", 10, &NewJoy2Twist::drive, this);'
ADVERTISED = 'cmd_vel_ = node_.advertise<geometry_msgs::Twist>("/cmd_vel", 10);'
# Without a handler of its own.
PLAIN = [put(CLASS, POINTER + HANDLER, ""), put(CLASS, OWN, ""), put(CLASS, INSTALLED, ""),
    put(CLASS, MADE, "  NewJoy2Twist node;\n")]  # fmt: skip


def without_handler(what, old, new, check, *words):
    return mistake(what, [*PLAIN, put(CLASS, old, new)], check, *words)


ROWS = [
    mistake("no class, but the functions again", [put(CLASS, "", ""), remove(CLASS),
        lambda src: (src / CLASS).write_text((src / JOY2TWIST).read_text())], "C29",
        "no class in any program", "src/new_joy2twist.cpp", "ros::NodeHandle"),
    mistake("a class in no add_executable", [put(f"{J}/CMakeLists.txt",
        "add_executable(new_joy2twist src/new_joy2twist.cpp)\n"
        "target_link_libraries(new_joy2twist ${catkin_LIBRARIES})\n", "")], "C29",
        "new_joy2twist.cpp is in no add_executable", "CMakeLists.txt:"),
    without_handler("a function in place of an object", "NewJoy2Twist node;",
        "NewJoy2Twist node();", "C29", "new_joy2twist.cpp:44", "NewJoy2Twist node();",
        "without ()"),
    without_handler("an object without a name", "NewJoy2Twist node;", "NewJoy2Twist();", "C29",
        "new_joy2twist.cpp:44", "NewJoy2Twist();", "NewJoy2Twist node;"),
    without_handler("never created", "  NewJoy2Twist node;\n", "  ros::NodeHandle node;\n", "C29",
        "new_joy2twist.cpp:7", "never created"),
    cls30("a Subscriber local to the constructor", SUBSCRIBED, "ros::Subscriber &",
        "new_joy2twist.cpp:13", "joy_"),
    cls30("a Subscriber that is not kept", "joy_ = node_.sub", "node_.sub", "new_joy2twist.cpp:13",
        "Subscriber"),
    cls30("a Publisher local to the constructor", ADVERTISED, "ros::Publisher &",
        "new_joy2twist.cpp:", "invalid Publisher"),
    mistake("bound to a copy without a Publisher", [put(CLASS, f"    {ADVERTISED}\n", ""),
        put(CLASS, "node_.subscribe(", "node_.subscribe<sensor_msgs::Joy>("),
        put(CLASS, "10, ", "10, boost::bind("),
        put(CLASS, "drive, this);", "drive, *this, boost::placeholders::_1));"),
        put(CLASS, "  }\n\n  void stop", f"    {ADVERTISED}\n  }}\n\n  void stop")], "C30",
        "new_joy2twist.cpp:", "invalid Publisher"),
    cls31("no ros::shutdown() in the handler", "  ros::shutdown();\n", "", "it still runs",
        "new_joy2twist.cpp:5", "ros::shutdown()"),
    cls31("ros::shutdown() before the zero", "  robot->stop();\n  ros::shutdown();\n",
        "  ros::shutdown();\n  robot->stop();\n", "after Ctrl-C: no zero", "new_joy2twist.cpp:45",
        "first the zero"),
    cls31("a handler without a zero", "  robot->stop();\n", "", "after Ctrl-C: no zero",
        "new_joy2twist.cpp:43", "geometry_msgs::Twist()"),
    cls31("a sleep before the zero", "  robot->stop();\n",
        "  ros::WallDuration(6.0).sleep();\n  robot->stop();\n", "after Ctrl-C",
        "new_joy2twist.cpp:45", "first the zero"),
    cls31("no handler beside NoSigintHandler", INSTALLED, "", "after Ctrl-C: no zero",
        "new_joy2twist.cpp:51", "signal(SIGINT, onCtrlC)"),
    mistake("a handler that roscpp replaces", [put(CLASS, OWN, ""), put(CLASS, INSTALLED, ""),
        put(CLASS, MADE, f"{INSTALLED}&")], "C31", "after Ctrl-C: no zero",
        "new_joy2twist.cpp:52", "ros::init_options::NoSigintHandler"),
    cls31("a Twist that moves, from the handler", "cmd_vel_.publish(geometry_msgs::Twist());",
        "geometry_msgs::Twist twist;\n    twist.linear.x = 0.1;\n    cmd_vel_.publish(twist);",
        "after Ctrl-C: no zero", "new_joy2twist.cpp:22", "all zero"),
    cls31("a pointer that nobody sets", "  robot = &node;\n", "", "after Ctrl-C: no zero",
        "new_joy2twist.cpp:41", "points to no object"),
    without_handler("no zero at all", "  void stop()\n", "  void rest()\n", "C31",
        "after Ctrl-C: no zero", "new_joy2twist.cpp:43", "NoSigintHandler", "ros::shutdown()"),
    without_handler("a zero after ros::spin()", "ros::spin();\n", "&  node.stop();\n", "C31",
        "after Ctrl-C: no zero", "new_joy2twist.cpp:46", "after ros::spin() it is too late",
        "NoSigintHandler"),
    without_handler("a zero in the destructor", "  void stop()\n", "  ~NewJoy2Twist()\n", "C31",
        "after Ctrl-C: no zero", "new_joy2twist.cpp:20", "in the destructor it is too late"),
    without_handler("a zero below a loop of ros::ok()", "  ros::spin();\n",
        "  ros::Rate rate(50);\n  while (ros::ok())\n  {\n    ros::spinOnce();\n"
        "    rate.sleep();\n  }\n  node.stop();\n", "C31", "after Ctrl-C: no zero",
        "new_joy2twist.cpp:51", "below the loop of ros::ok() it is too late"),
    cls33("it ends without a joystick", SUBSCRIBED, "&\n    ros::Duration(1.0).sleep();\n"
        "    if (joy_.getNumPublishers() == 0)\n      exit(1);", "nobody publishes on /joy",
        "new_joy2twist.cpp", "ros::spin() waits"),
]  # fmt: skip
