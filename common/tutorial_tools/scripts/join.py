#!/usr/bin/python3
"""Join a classroom: see tutorial_tools/join.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends this quietly

from tutorial_tools.join import main

main()
