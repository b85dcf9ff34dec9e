#!/usr/bin/python3
"""Simulate a TurtleBot 2; fake_turtlebot_sim.node says which topics and parameters it has."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from fake_turtlebot_sim.node import main

sys.exit(main())
