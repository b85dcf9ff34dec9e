// As teleop_twist_joy: C++, a button that enables, one zero when it is released.
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "teleop_joy");
  ros::NodeHandle node, own("~");
  const int button = own.param("enable_button", 0);
  bool was_enabled = false;
  ros::Publisher pub = node.advertise<geometry_msgs::Twist>("cmd_vel", 1, true);
  boost::function<void(const sensor_msgs::JoyConstPtr&)> drive = [&](const sensor_msgs::JoyConstPtr& joy) {
    const bool enabled = joy->buttons.at(button);
    geometry_msgs::Twist twist;
    if (enabled) twist.linear.x = 0.5 * joy->axes.at(1);
    if (enabled || was_enabled) pub.publish(twist);
    was_enabled = enabled;
  };
  ros::Subscriber sub = node.subscribe<sensor_msgs::Joy>("joy", 1, drive);
  ros::spin();
}
