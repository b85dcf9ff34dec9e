#!/usr/bin/python3
"""Back a bumped robot off: see fake_turtlebot_sim/safety/node.py."""

import sys

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from fake_turtlebot_sim.safety.node import main

sys.exit(main())
