#!/usr/bin/python3
"""Back a bumped robot away: see fake_turtlebot_sim/ros/safety_controller_node.py."""

import sys

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.ros.safety_controller_node import main

sys.exit(main())
