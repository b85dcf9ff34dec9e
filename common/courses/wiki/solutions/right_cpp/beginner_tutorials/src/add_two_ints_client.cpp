// Ask for the sum of two numbers.
#include <cstdlib>

#include <beginner_tutorials/AddTwoInts.h>
#include <ros/ros.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "add_two_ints_client");
  if (argc != 3)
  {
    ROS_ERROR("usage: add_two_ints_client x y");
    return 1;
  }
  ros::NodeHandle node;
  auto client = node.serviceClient<beginner_tutorials::AddTwoInts>("add_two_ints");
  client.waitForExistence();

  beginner_tutorials::AddTwoInts add;
  add.request.a = std::atoll(argv[1]);
  add.request.b = std::atoll(argv[2]);
  if (!client.call(add))
  {
    ROS_ERROR("the server has not answered");
    return 1;
  }
  ROS_INFO_STREAM(add.request.a << " + " << add.request.b << " = " << add.response.sum);
  return 0;
}
