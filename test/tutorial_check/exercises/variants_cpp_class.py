"""Right solutions of 6.2 in C++: classes that stop the robot when they are ended."""

from edits import copy, move, put, put_cpp, write
from rows import right
from solution import JOY_CMAKE, J
from solution_cpp import CLASS, JOY2TWIST

HANDLER = """NewJoy2Twist* robot = nullptr;

void onCtrlC(int)
{
  robot->stop();
  ros::shutdown();
}
"""
FLAG = """volatile sig_atomic_t ended = 0;

void onCtrlC(int)
{
  ended = 1;
}
"""
LOOP = """  ros::Rate rate(50);
  while (ros::ok() && !ended)
  {
    ros::spinOnce();
    rate.sleep();
  }
  node.stop();
  ros::shutdown();
"""
BOUND = """  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", onKill);
"""
ON_KILL = """
void onKill(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result)
{
  ended = 1;
  result = ros::xmlrpc::responseInt(1, "", 0);
}
"""
RUN = """  void run()
  {
    while (ros::ok() && !ended)
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    stop();
    ros::shutdown();
  }

"""
PAUSE = "    ros::WallDuration(0.2).sleep();\n"
ZERO = "    cmd_vel_.publish(geometry_msgs::Twist());\n"
STOP = f"""  void stop()
  {{
    ROS_INFO("The robot is being stopped");
    joy_.shutdown();
{ZERO}{PAUSE}  }}

"""
MEMBERS = """  ros::NodeHandle node_;
  ros::Publisher cmd_vel_;
  ros::Subscriber joy_;
};

NewJoy2Twist* robot"""
BASE = f"""class Robot
{{
public:
  virtual ~Robot() = default;

  void stop()
  {{
{ZERO}{PAUSE}  }}

protected:
  ros::NodeHandle node_;
  ros::Publisher cmd_vel_;
}};

class NewJoy2Twist : public Robot
"""
SPIN = "  ros::spin();\n"
PREFIX = "  NewJoy2Twist node;\n  robot = &node;\n"


def cls(what, *changes):
    return right(what, "6.2", *(put_cpp(CLASS, old, new) for old, new in changes))


FLAGGED = [
    (HANDLER, FLAG), ("  robot = &node;\n", ""), (SPIN, LOOP),
]  # fmt: skip
OWN = """#include <csignal>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

class TeleopNode
{
public:
  TeleopNode(ros::NodeHandle node, ros::NodeHandle own)
    : scale_linear_(own.param("scale_linear", 1.0)),
      scale_angular_(own.param("scale_angular", 1.0)),
      button_(own.param("enable_button", 4)),
      cmd_vel_(node.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
      joy_(node.subscribe<sensor_msgs::Joy>("joy", 10, [this](const auto& joy) { drive(*joy); }))
  {
    instance_ = this;
    signal(SIGINT, &TeleopNode::onSignal);
  }

  void run()
  {
    ros::AsyncSpinner spinner(1);
    spinner.start();
    ros::waitForShutdown();
  }

private:
  static void onSignal(int)
  {
    instance_->joy_.shutdown();
    instance_->cmd_vel_.publish(geometry_msgs::Twist());
    ros::Duration(0.5).sleep();
    ros::shutdown();
  }

  void drive(const sensor_msgs::Joy& joy)
  {
    geometry_msgs::Twist twist;
    if (static_cast<int>(joy.buttons.size()) > button_ && joy.buttons[button_])
    {
      twist.linear.x = scale_linear_ * joy.axes[1];
      twist.angular.z = scale_angular_ * joy.axes[0];
    }
    ROS_INFO("axes [%.2f, %.2f]: v %.2f, w %.2f", joy.axes[0], joy.axes[1], twist.linear.x,
             twist.angular.z);
    cmd_vel_.publish(twist);
  }

  static TeleopNode* instance_;
  double scale_linear_, scale_angular_;
  int button_;
  ros::Publisher cmd_vel_;
  ros::Subscriber joy_;
};

TeleopNode* TeleopNode::instance_ = nullptr;

int main(int argc, char** argv)
{
  ros::init(argc, argv, "new_joy2twist", ros::init_options::NoSigintHandler);
  TeleopNode(ros::NodeHandle(), ros::NodeHandle("~")).run();
}
"""
HEADER = """#ifndef JOY2TWIST_NEW_JOY2TWIST_H
#define JOY2TWIST_NEW_JOY2TWIST_H

#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

namespace joy2twist
{
class NewJoy2Twist
{
public:
  NewJoy2Twist();
  void stop();

private:
  void drive(const sensor_msgs::JoyConstPtr& joy);

  ros::NodeHandle node_;
  ros::Publisher cmd_vel_;
  ros::Subscriber joy_;
};
}

#endif
"""
SOURCE = """#include <joy2twist/new_joy2twist.h>

#include <geometry_msgs/Twist.h>

namespace joy2twist
{
NewJoy2Twist::NewJoy2Twist()
  : cmd_vel_(node_.advertise<geometry_msgs::Twist>("/cmd_vel", 10)),
    joy_(node_.subscribe("/joy", 10, &NewJoy2Twist::drive, this))
{
}

void NewJoy2Twist::drive(const sensor_msgs::JoyConstPtr& joy)
{
  ROS_INFO_STREAM("forwards " << joy->axes[1] << ", to the left " << joy->axes[0]);
  geometry_msgs::Twist twist;
  twist.linear.x = joy->axes[1];
  twist.angular.z = joy->axes[0];
  cmd_vel_.publish(twist);
}

void NewJoy2Twist::stop()
{
  cmd_vel_.publish(geometry_msgs::Twist());
  ros::WallDuration(0.5).sleep();
}
}
"""
MAIN_ALONE = """#include <memory>
#include <signal.h>

#include <joy2twist/new_joy2twist.h>

std::shared_ptr<joy2twist::NewJoy2Twist> node;

void end(int sig)
{
  node->stop();
  ros::shutdown();
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "new_joy2twist", ros::init_options::NoSigintHandler);
  node = std::make_shared<joy2twist::NewJoy2Twist>();
  struct sigaction action = {};
  action.sa_handler = end;
  sigaction(SIGINT, &action, nullptr);
  ros::spin();
  node.reset();
  return 0;
}
"""

ROWS = [
    cls("a flag that the handler sets, and a loop", *FLAGGED),
    cls("a flag, which rosnode kill sets as well", *FLAGGED,
        ("#include <ros/ros.h>\n", "@#include <ros/xmlrpc_manager.h>\n"), (FLAG, f"@{ON_KILL}"),
        ("  ros::Rate rate", f"{BOUND}@")),
    cls("an atomic flag, and a method with the loop",
        ("#include <csignal>\n", "#include <atomic>\n@"),
        ("#include <ros/ros.h>\n", "#include <ros/callback_queue.h>\n@"),
        ("class NewJoy2Twist\n", "std::atomic<bool> ended(false);\n\n@"),
        (HANDLER, "void onCtrlC(int)\n{\n  ended = true;\n}\n"), ("  void stop()\n", f"{RUN}@"),
        (PREFIX, "  NewJoy2Twist node;\n"), (SPIN, "  node.run();\n")),
    cls("made by new", (PREFIX, "  robot = new NewJoy2Twist();\n"),
        (SPIN, f"{SPIN}  delete robot;\n")),
    cls("std::unique_ptr, a lambda as the handler",
        ("#include <csignal>\n", "@#include <memory>\n"),
        (HANDLER, "std::unique_ptr<NewJoy2Twist> robot;\n"),
        (PREFIX, "  robot = std::make_unique<NewJoy2Twist>();\n"),
        ("signal(SIGINT, onCtrlC);", "signal(SIGINT, [](int) {\n    robot->stop();\n"
        "    ros::shutdown();\n  });"), (SPIN, f"{SPIN}  robot.reset();\n")),
    cls("five zeros", (ZERO + PAUSE, f"    for (int i = 0; i < 5; ++i)\n    {{\n  {ZERO}"
        "      ros::Duration(0.05).sleep();\n    }\n")),
    cls("the handler after the NodeHandle, without the option",
        (", ros::init_options::NoSigintHandler", "")),
    cls("anonymous, without a pause", (PAUSE, ""),
        ("NoSigintHandler);", "NoSigintHandler | ros::init_options::AnonymousName);")),
    cls("a base class that stops", (STOP, ""), ("class NewJoy2Twist\n", BASE),
        (MEMBERS, "  ros::Subscriber joy_;\n};\n\nNewJoy2Twist* robot")),
    right("a static handler, parameters, a dead-man button, AsyncSpinner", "6.2",
        write(CLASS, OWN)),
    right("methods defined below the class", "6.2", write(CLASS, HEADER
        + (SOURCE + MAIN_ALONE).replace("#include <joy2twist/new_joy2twist.h>\n", ""))),
    right("header, source and main in three files", "6.2",
        write(f"{J}/include/{J}/new_joy2twist.h", HEADER), write(CLASS, SOURCE),
        write(f"{J}/src/main.cpp", MAIN_ALONE), put(JOY_CMAKE, "src/new_joy2twist.cpp",
        "src/main.cpp &"), put(JOY_CMAKE, "include_directories(", "&include ")),
    right("the class in a library", "6.2",
        write(f"{J}/include/{J}/new_joy2twist.h", HEADER), move(CLASS, f"{J}/src/robot.cpp"),
        write(f"{J}/src/robot.cpp", SOURCE), write(f"{J}/src/main.cpp", MAIN_ALONE),
        put(JOY_CMAKE, "add_executable(new_joy2twist src/new_joy2twist.cpp)",
        "add_library(robot src/robot.cpp)\ntarget_link_libraries(robot ${catkin_LIBRARIES})\n"
        "add_executable(new_joy2twist src/main.cpp)"),
        put(JOY_CMAKE, "(new_joy2twist ${catkin_LIBRARIES})",
        "(new_joy2twist robot ${catkin_LIBRARIES})"),
        put(JOY_CMAKE, "include_directories(", "&include "),
        put(JOY_CMAKE, "catkin_package()", "catkin_package(INCLUDE_DIRS include LIBRARIES robot "
        "CATKIN_DEPENDS roscpp sensor_msgs geometry_msgs)")),
    right("the class in joy2twist.cpp", "4.3 6.2", copy(CLASS, JOY2TWIST)),
]  # fmt: skip
