"""Shows a ROS 1 master in Foxglove and Lichtblick, in place of foxglove_bridge."""
