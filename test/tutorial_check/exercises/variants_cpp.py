"""Right solutions in C++ that differ from the literal one, and those of 4.3 to 4.5."""

from edits import put, put_cpp, write
from rows import right
from solution import JOY_CMAKE, J
from solution_cpp import JOY2TWIST, PUB, PUBLISH, SHOW, SUB, X
from variants_cpp_class import ROWS as CLASSES
from variants_cpp_talker import ROWS as TALKERS

JOY = "const sensor_msgs::Joy::ConstPtr& joy"
SPIN = "  ros::spin();\n"


def driver(what, *changes, exercises="4.3"):
    return right(what, exercises, *(put_cpp(JOY2TWIST, old, new) for old, new in changes))


DRIVER_CLASS = """#include <sstream>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

// Drives with the left stick, while the button LB is held.
class Driver
{
public:
  Driver() : own_("~")
  {
    own_.param("axis_linear", axis_linear_, 1);
    own_.param("axis_angular", axis_angular_, 0);
    own_.param("enable_button", button_, 4);
    scale_ = own_.param("scale", 1.0);
    cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    joy_ = node_.subscribe("joy", 10, &Driver::drive, this, ros::TransportHints().tcpNoDelay());
  }

private:
  void drive(const sensor_msgs::Joy& joy)
  {
    std::ostringstream text;
    text.precision(2);
    text << std::fixed;
    for (const float axis : joy.axes)
      text << axis << " ";
    ROS_INFO_STREAM(text.str());

    geometry_msgs::Twist twist;
    if (button_ < static_cast<int>(joy.buttons.size()) && joy.buttons[button_])
    {
      twist.linear.x = scale_ * joy.axes.at(axis_linear_);
      twist.angular.z = scale_ * joy.axes.at(axis_angular_);
    }
    cmd_vel_.publish(twist);
  }

  ros::NodeHandle node_, own_;
  ros::Publisher cmd_vel_;
  ros::Subscriber joy_;
  int axis_linear_, axis_angular_, button_;
  double scale_;
};

int main(int argc, char** argv)
{
  ros::init(argc, argv, "joy2twist");
  Driver driver;
  ros::spin();
  return 0;
}
"""
DRIVER_LAMBDA = """#include <cstdio>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

using geometry_msgs::Twist;
using sensor_msgs::Joy;

int main(int argc, char** argv)
{
  ros::init(argc, argv, "joy2twist", ros::init_options::AnonymousName);
  ros::NodeHandle node("~");
  auto cmd_vel = node.advertise<Twist>("/cmd_vel", 10);
  auto drive = [&cmd_vel](const Joy::ConstPtr& joy)
  {
    for (size_t i = 0; i < joy->axes.size(); ++i)
      printf("%s%.2f", i ? ", " : "axes: ", joy->axes[i]);
    puts("");
    Twist twist;
    twist.linear.x = joy->axes[1];
    twist.angular.z = joy->axes[0];
    cmd_vel.publish(twist);
  };
  auto stick = node.subscribe<Joy>("/joy", 10, drive);
  ros::spin();
}
"""
ROWS = [
    *TALKERS,
    right("a class with a dead-man button and parameters", "4.3 4.4 4.5",
        write(JOY2TWIST, DRIVER_CLASS)),
    right("a lambda that has the publisher, a private NodeHandle, printf", "4.3 4.4",
        write(JOY2TWIST, DRIVER_LAMBDA)),
    driver("JoyConstPtr, a pointer to the Twist",
        (JOY, "const sensor_msgs::JoyConstPtr& joy"), ("  geometry_msgs::Twist twist;\n",
        "  geometry_msgs::TwistPtr message(new geometry_msgs::Twist);\n"
        "  geometry_msgs::Twist& twist = *message;\n"), (PUBLISH, "cmd_vel.publish(message);")),
    driver("a pointer to the publisher", ("ros::Publisher cmd_vel;", "ros::Publisher* pub;"),
        (PUBLISH, "pub->publish(twist);"), (PUB, f"ros::Publisher {PUB}\n  pub = &cmd_vel;")),
    driver("a publisher that the first Joy makes", ("ros::Publisher cmd_vel;\n\n", ""),
        (f"  {PUB}\n", ""), (f"  {PUBLISH}", "  static ros::NodeHandle node;\n"
        f"  static ros::Publisher {PUB}\n@")),
    driver("the subscriber first, with a queue of 1", (f"  {PUB}\n", ""),
        (SUB, f"{SUB}\n  {PUB}"), ('"/joy", 10', '"/joy", 1')),
    driver("half the speed, topics and factors as constants", ("ros::Publisher cmd_vel;",
        '@\nconst std::string JOY = "joy", CMD_VEL = "cmd_vel";\nconst double SCALE = 0.5;'),
        ('"/joy"', "JOY"), ('"/cmd_vel"', "CMD_VEL"), (X, "twist.linear.x = SCALE * joy->axes[1];"),
        exercises="4.3 4.4"),
    driver("the values in a text, AsyncSpinner with one thread", (SHOW,
        '  std::string text = "axes";\n  for (float axis : joy->axes)\n  {\n    char value[16];\n'
        '    snprintf(value, sizeof(value), " %.2f", axis);\n    text += value;\n  }\n'
        "  ROS_WARN_STREAM(text);\n"), (SPIN,
        "  ros::AsyncSpinner spinner(1);\n  spinner.start();\n  ros::waitForShutdown();\n")),
    driver("a loop with spinOnce that also sleeps", (SPIN, "  ros::Rate rate(100);\n"
        "  while (ros::ok())\n  {\n    ros::spinOnce();\n    rate.sleep();\n  }\n"),
        exercises="4.3 4.4"),
    right("a class in a header", "4.3",
        write(f"{J}/include/{J}/driver.h", DRIVER_CLASS.partition("int main")[0].replace("#include",
        "#pragma once\n#include", 1)), write(JOY2TWIST, f"#include <{J}/driver.h>\n\nint main"
        + DRIVER_CLASS.partition("int main")[2]), put(JOY_CMAKE, "include_directories(",
        "&include ")),
    *CLASSES,
]  # fmt: skip
