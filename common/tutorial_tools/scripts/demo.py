#!/usr/bin/python3
"""Run the tutorial's demonstration: see tutorial_tools/demo/program.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from tutorial_tools.demo.program import main

main()
