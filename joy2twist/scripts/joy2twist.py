#!/usr/bin/python3
"""Drive a robot with a joystick: see the class Joy2Twist in joy_to_twist/ros/joy2twist_node.py."""

import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while ROS still loads ends this quietly

from joy_to_twist.ros.joy2twist_node import main

sys.exit(main())
