// Drive turtle1 to a goal.
#include <cmath>
#include <iostream>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <turtlesim/Pose.h>

class Turtle
{
public:
  Turtle()
  {
    publisher_ = node_.advertise<geometry_msgs::Twist>("turtle1/cmd_vel", 10);
    subscriber_ = node_.subscribe("turtle1/pose", 10, &Turtle::keep, this);
  }

  void driveTo(double x, double y, double tolerance)
  {
    ros::Rate rate(10);
    while (ros::ok() && (!has_pose_ || gapTo(x, y) >= tolerance))
    {
      if (has_pose_)
        publisher_.publish(towards(x, y));
      ros::spinOnce();
      rate.sleep();
    }
    publisher_.publish(geometry_msgs::Twist());
  }

private:
  void keep(const turtlesim::Pose& pose)
  {
    pose_ = pose;
    has_pose_ = true;
  }

  double gapTo(double x, double y) const
  {
    return std::hypot(x - pose_.x, y - pose_.y);
  }

  geometry_msgs::Twist towards(double x, double y) const
  {
    const double turn = std::atan2(y - pose_.y, x - pose_.x) - pose_.theta;
    geometry_msgs::Twist twist;
    twist.linear.x = 1.5 * gapTo(x, y);
    twist.angular.z = 6.0 * std::remainder(turn, 2.0 * M_PI);
    return twist;
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  turtlesim::Pose pose_;
  bool has_pose_ = false;
};

int main(int argc, char** argv)
{
  ros::init(argc, argv, "gotogoal");
  double x, y, tolerance;
  std::cout << "x, y and tolerance: ";
  std::cin >> x >> y >> tolerance;
  Turtle turtle;
  turtle.driveTo(x, y, tolerance);
  ros::spin();
  return 0;
}
