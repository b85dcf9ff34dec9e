#!/usr/bin/python3
"""Draw the running nodes and topics: see tutorial_tools/graph.py."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends this quietly

from tutorial_tools.graph import main

main()
