#!/usr/bin/python3
"""Back a bumped robot off: see fake_turtlebot_sim/safety/node.py."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from fake_turtlebot_sim.safety.node import main

sys.exit(main())
