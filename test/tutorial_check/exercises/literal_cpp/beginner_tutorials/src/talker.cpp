#include <sstream>

#include <ros/ros.h>
#include <std_msgs/String.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "talker", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", 10);

  ros::Rate rate(10);
  while (ros::ok())
  {
    std::ostringstream text;
    text << "good day at " << ros::Time::now();

    std_msgs::String message;
    message.data = text.str();
    ROS_INFO("%s", message.data.c_str());
    publisher.publish(message);

    rate.sleep();
  }
  return 0;
}
