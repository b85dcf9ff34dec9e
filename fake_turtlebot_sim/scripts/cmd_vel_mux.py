#!/usr/bin/python3
"""Multiplex velocity commands: see fake_turtlebot_sim/ros/cmd_vel_mux_node.py."""

import sys

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.ros.cmd_vel_mux_node import main

sys.exit(main())
