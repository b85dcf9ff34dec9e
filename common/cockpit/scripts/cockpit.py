#!/usr/bin/python3
"""Robots in a browser: see cockpit_server/program.py."""

import node_kit.quiet  # noqa: F401  Ctrl-C ends it quietly while ROS loads
from cockpit_server.program import main

raise SystemExit(main())
