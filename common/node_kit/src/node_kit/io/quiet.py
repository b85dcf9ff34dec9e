"""Imported first, this lets Ctrl-C end a program quietly while ROS loads; later, ending does."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)
