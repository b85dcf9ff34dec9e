#!/usr/bin/python3
"""Run the tutorial's demonstration: see tutorial_tools/ros/demo/demo.py."""

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.ros.demo.demo import main

main()
