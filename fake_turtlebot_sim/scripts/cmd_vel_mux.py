#!/usr/bin/python3
"""Let one of several sources of velocity commands drive; fake_turtlebot_sim.mux_node says more."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from fake_turtlebot_sim.mux_node import main

sys.exit(main())
