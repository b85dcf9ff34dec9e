#!/usr/bin/python3
"""Join a classroom: see tutorial_tools/ros/join.py."""

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.ros.join import main

main()
