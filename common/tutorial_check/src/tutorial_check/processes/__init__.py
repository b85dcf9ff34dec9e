"""Programs, their output and time, helper processes, a ROS master. Tests use it."""
