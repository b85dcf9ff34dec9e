#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

ros::Publisher cmd_vel;

void drive(const sensor_msgs::Joy::ConstPtr& joy)
{
  ROS_INFO("axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]", joy->axes[0], joy->axes[1], joy->axes[2],
           joy->axes[3], joy->axes[4], joy->axes[5]);

  geometry_msgs::Twist twist;
  twist.linear.x = joy->axes[1];
  twist.angular.z = joy->axes[0];
  cmd_vel.publish(twist);
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "joy2twist", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  cmd_vel = node.advertise<geometry_msgs::Twist>("/cmd_vel", 10);
  ros::Subscriber stick = node.subscribe("/joy", 10, drive);
  ros::spin();
  return 0;
}
