"""The literal solution in C++: its files, and the lines that rows change."""

from solution import B, J

TALKER, LISTENER = f"{B}/src/talker.cpp", f"{B}/src/listener.cpp"
JOY2TWIST, CLASS = f"{J}/src/joy2twist.cpp", f"{J}/src/new_joy2twist.cpp"
X, Z = "twist.linear.x = joy->axes[1];", "twist.angular.z = joy->axes[0];"
PUBLISH = "cmd_vel.publish(twist);"
SUB = 'ros::Subscriber stick = node.subscribe("/joy", 10, drive);'
PUB = 'cmd_vel = node.advertise<geometry_msgs::Twist>("/cmd_vel", 10);'
SHOW = (
    '  ROS_INFO("axes [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f]", joy->axes[0], joy->axes[1], '
    "joy->axes[2],\n           joy->axes[3], joy->axes[4], joy->axes[5]);\n"
)
