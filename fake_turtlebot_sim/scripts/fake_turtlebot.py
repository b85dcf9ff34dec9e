#!/usr/bin/python3
"""Simulate a TurtleBot 2: see fake_turtlebot_sim/simulator/node.py."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from fake_turtlebot_sim.simulator.node import main

sys.exit(main())
