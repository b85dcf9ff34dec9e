// Drive a square of 1 m, by time.
#include <cmath>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

const double SPEED = 0.5;       // [m/s]
const double TURN = M_PI / 4.0; // [rad/s]

void drive(const ros::Publisher& publisher, double v, double w, double seconds)
{
  geometry_msgs::Twist twist;
  twist.linear.x = v;
  twist.angular.z = w;
  const ros::Time end = ros::Time::now() + ros::Duration(seconds);
  for (ros::Rate rate(50); ros::ok() && ros::Time::now() < end; rate.sleep())
    publisher.publish(twist);
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "square");
  ros::NodeHandle node;
  ros::Publisher cmd_vel = node.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  while (ros::ok() && cmd_vel.getNumSubscribers() == 0)
    ros::Duration(0.05).sleep();

  for (int side = 0; side < 4; ++side)
  {
    drive(cmd_vel, SPEED, 0.0, 1.0 / SPEED);
    drive(cmd_vel, 0.0, TURN, M_PI / 2.0 / TURN);
  }
  drive(cmd_vel, 0.0, 0.0, 1.0);
  return 0;
}
