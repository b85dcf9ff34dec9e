#!/usr/bin/python3
"""Draw the running nodes and topics: see tutorial_tools/graph.py."""

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.graph import main

main()
