#!/usr/bin/python3
"""Run the tutorial's demonstration: see joy_to_twist/demo.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from joy_to_twist.demo import main

if __name__ == "__main__":
    main()
