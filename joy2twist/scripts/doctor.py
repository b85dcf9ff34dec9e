#!/usr/bin/python3
"""What to check when nothing moves: see joy_to_twist/doctor/program.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends this quietly

from joy_to_twist.doctor.program import main

if __name__ == "__main__":
    main()
