"""Import this first: Ctrl-C then ends the program quietly while ROS loads."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)
