// Add two numbers.
#include <beginner_tutorials/AddTwoInts.h>
#include <ros/ros.h>

using beginner_tutorials::AddTwoInts;

bool add(AddTwoInts::Request& request, AddTwoInts::Response& response)
{
  response.sum = request.a + request.b;
  ROS_INFO_STREAM(request.a << " and " << request.b << " make " << response.sum);
  return true;
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "add_two_ints_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("add_two_ints", add);
  ROS_INFO("ready to add");
  ros::spin();
  return 0;
}
