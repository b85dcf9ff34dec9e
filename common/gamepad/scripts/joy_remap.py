#!/usr/bin/python3
"""Makes one gamepad look like another: see the class JoyRemap in gamepad/remap/node.py."""

import sys

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from gamepad.remap.node import main

sys.exit(main())
