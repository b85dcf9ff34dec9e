// Give turtlesim another background: R G B.
#include <cstdlib>

#include <ros/ros.h>
#include <std_srvs/Empty.h>

int main(int argc, char** argv)
{
  ros::init(argc, argv, "background");
  ros::NodeHandle node;
  auto clear = node.serviceClient<std_srvs::Empty>("clear");
  clear.waitForExistence();
  if (argc != 4)
  {
    ROS_ERROR("usage: background R G B");
    return 1;
  }
  node.setParam("/turtlesim/background_r", std::atoi(argv[1]));
  node.setParam("/turtlesim/background_g", std::atoi(argv[2]));
  node.setParam("/turtlesim/background_b", std::atoi(argv[3]));

  std_srvs::Empty empty;
  clear.call(empty);
  return 0;
}
