"""What programs are seen to do: a ROS master, our end of the topics."""
