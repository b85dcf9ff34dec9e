#!/usr/bin/python3
"""Simulate a TurtleBot 2: see fake_turtlebot_sim/ros/fake_turtlebot_node.py."""

import sys

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.ros.fake_turtlebot_node import main

sys.exit(main())
