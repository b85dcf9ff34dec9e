#!/usr/bin/python3
"""What to check when nothing moves: see tutorial_tools/ros/doctor/doctor.py."""

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.io.environment import leave_ros2

leave_ros2()  # before the first import of a message

from tutorial_tools.ros.doctor.doctor import main

main()
