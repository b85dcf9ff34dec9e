#!/usr/bin/python3
"""Let one of several sources of velocities drive: see fake_turtlebot_sim/mux/node.py."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from fake_turtlebot_sim.mux.node import main

sys.exit(main())
