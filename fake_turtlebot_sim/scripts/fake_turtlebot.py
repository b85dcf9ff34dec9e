#!/usr/bin/python3
"""Simulate a TurtleBot 2: see fake_turtlebot_sim/simulator/node.py."""

import sys

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.simulator.node import main

sys.exit(main())
