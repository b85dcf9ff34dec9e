#include <csignal>

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>

class NewJoy2Twist
{
public:
  NewJoy2Twist()
  {
    cmd_vel_ = node_.advertise<geometry_msgs::Twist>("/cmd_vel", 10);
    joy_ = node_.subscribe("/joy", 10, &NewJoy2Twist::drive, this);
  }

  void stop()
  {
    ROS_INFO("The robot is being stopped");
    joy_.shutdown();
    cmd_vel_.publish(geometry_msgs::Twist());
    ros::WallDuration(0.2).sleep();
  }

private:
  void drive(const sensor_msgs::Joy::ConstPtr& joy)
  {
    ROS_INFO("axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]", joy->axes[0], joy->axes[1],
             joy->axes[2], joy->axes[3], joy->axes[4], joy->axes[5]);

    geometry_msgs::Twist twist;
    twist.linear.x = joy->axes[1];
    twist.angular.z = joy->axes[0];
    cmd_vel_.publish(twist);
  }

  ros::NodeHandle node_;
  ros::Publisher cmd_vel_;
  ros::Subscriber joy_;
};

NewJoy2Twist* robot = nullptr;

void onCtrlC(int)
{
  robot->stop();
  ros::shutdown();
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "new_joy2twist", ros::init_options::NoSigintHandler);
  NewJoy2Twist node;
  robot = &node;
  signal(SIGINT, onCtrlC);
  ros::spin();
  return 0;
}
