#!/usr/bin/python3
"""Robots in a browser: see cockpit_server/program.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from cockpit_server.program import main

raise SystemExit(main())
