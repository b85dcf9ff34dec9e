"""What programs after ROS by Example import."""
