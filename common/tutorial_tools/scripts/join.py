#!/usr/bin/python3
"""Join a classroom: see tutorial_tools/join.py."""

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from tutorial_tools.join import main

main()
