#include <ros/ros.h>
#include <std_msgs/String.h>

void hear(const std_msgs::String::ConstPtr& message)
{
  ROS_INFO("%s heard: %s", ros::this_node::getName().c_str(), message->data.c_str());
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "listener", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::Subscriber subscriber = node.subscribe("chatter", 10, hear);
  ros::spin();
  return 0;
}
