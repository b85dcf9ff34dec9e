"""The module that programs after the book ROS by Example import."""
