"""Programs, their output and CPU time, helper processes, a ROS master. Tests use it."""
