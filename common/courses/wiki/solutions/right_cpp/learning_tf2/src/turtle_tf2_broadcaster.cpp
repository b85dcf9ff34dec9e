// Broadcast the pose of a turtle.
#include <cmath>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>
#include <turtlesim/Pose.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "turtle_tf2_broadcaster");
  ros::NodeHandle node;
  std::string turtle = ros::NodeHandle("~").param<std::string>("turtle", "turtle1");
  tf2_ros::TransformBroadcaster broadcaster;

  auto broadcast = [&](const turtlesim::Pose::ConstPtr& pose) {
    geometry_msgs::TransformStamped frame;
    frame.header.stamp = ros::Time::now();
    frame.header.frame_id = "world";
    frame.child_frame_id = turtle;
    frame.transform.translation.x = pose->x;
    frame.transform.translation.y = pose->y;
    frame.transform.rotation.z = std::sin(pose->theta / 2.0);
    frame.transform.rotation.w = std::cos(pose->theta / 2.0);
    broadcaster.sendTransform(frame);
  };
  auto subscriber = node.subscribe<turtlesim::Pose>("/" + turtle + "/pose", 10, broadcast);
  ros::spin();
  return 0;
}
