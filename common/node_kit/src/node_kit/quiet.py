"""Imported first, this lets Ctrl-C end a program quietly while ROS loads; a node has ending later."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)
