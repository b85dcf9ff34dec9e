// Follow turtle1 with another turtle.
#include <cmath>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>
#include <turtlesim/Spawn.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "turtle_tf2_listener");
  ros::NodeHandle node;
  ros::service::waitForService("spawn");
  turtlesim::Spawn spawn;
  spawn.request.x = 4.0;
  spawn.request.y = 2.0;
  spawn.request.name = "turtle2";
  node.serviceClient<turtlesim::Spawn>("spawn").call(spawn);

  ros::Publisher publisher = node.advertise<geometry_msgs::Twist>("turtle2/cmd_vel", 1);
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  ros::Rate rate(10);
  for (; ros::ok(); rate.sleep())
  {
    try
    {
      auto ahead = buffer.lookupTransform("turtle2", "turtle1", ros::Time(0)).transform.translation;
      geometry_msgs::Twist twist;
      twist.angular.z = 4.0 * std::atan2(ahead.y, ahead.x);
      twist.linear.x = 0.5 * std::hypot(ahead.x, ahead.y);
      publisher.publish(twist);
    }
    catch (const tf2::TransformException&)
    {
      // The frames are not there yet.
    }
  }
  return 0;
}
