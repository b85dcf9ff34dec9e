#!/usr/bin/python3
"""Join a classroom: see tutorial_tools/join/program.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends this quietly

from tutorial_tools.join.program import main

if __name__ == "__main__":
    main()
