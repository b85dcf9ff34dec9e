#!/usr/bin/python3
"""Draw the running nodes and topics: see tutorial_tools/ros/draw_graph.py."""

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.ros.draw_graph import main

main()
