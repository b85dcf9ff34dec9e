#!/usr/bin/python3
"""Robots in a browser: see cockpit_server/ros/cockpit_command.py."""

import node_kit.io.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from cockpit_server.ros.cockpit_command import main

raise SystemExit(main())
