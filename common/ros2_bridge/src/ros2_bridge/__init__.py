"""A bridge between ROS 1 and ROS 2: two processes, and one that starts them."""
