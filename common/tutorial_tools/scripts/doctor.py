#!/usr/bin/python3
"""What to check when nothing moves: see tutorial_tools/doctor/program.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends this quietly

from tutorial_tools.doctor.environment import leave_ros2

leave_ros2()  # before the first import of a message

from tutorial_tools.doctor.program import main

main()
