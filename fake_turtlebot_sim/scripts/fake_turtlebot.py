#!/usr/bin/env python3
"""Simulate a TurtleBot 2; fake_turtlebot_sim.node says which topics and parameters it has."""

import sys

from fake_turtlebot_sim.node import main

sys.exit(main())
