"""From a bag of commands to a bag of odometry."""
