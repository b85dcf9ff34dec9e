#!/usr/bin/python3
"""Let one of several sources of velocities drive: see fake_turtlebot_sim/mux/node.py."""

import sys

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.mux.node import main

sys.exit(main())
