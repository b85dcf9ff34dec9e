#!/usr/bin/python3
"""Make one gamepad look like another: see the class JoyRemap in gamepad/ros/joy_remap_node.py."""

import sys

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from gamepad.ros.joy_remap_node import main

sys.exit(main())
