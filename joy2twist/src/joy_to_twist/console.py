"""What the node shows to its user."""

import contextlib
import logging
import queue
import threading
import time

import rospy
from rosgraph.roslogging import RosStreamHandler

from joy_to_twist.throttle import Throttle

BURST_S = 0.1  # lets every message of a bag through that comes at log_rate, but not quite evenly
GATHER_S = 0.25  # lines within this time are shown together: to wake a thread for each costs more
LONGEST_QUEUE = 1000  # lines kept for a screen that is held


class Console:
    """Shows lines from a thread of its own, so that driving never waits for a screen or a master.

    rospy asks the master a question for every line that it logs, and a screen may be held.
    """

    def __init__(self, log_rate):
        """log_rate: how many messages a second are displayed at most."""
        self._lines = queue.SimpleQueue()
        self._may_display = Throttle(log_rate, burst=max(1.0, log_rate * BURST_S))
        self._prefix = f"{rospy.get_name()}: Get from Joy"
        self._display = _console_logger("joy")
        threading.Thread(target=self._show, daemon=True).start()

    def display(self, axes, now):
        """Show the axes of a joystick message, as the tutorial does."""
        if self._may_display.ready(now) and self._lines.qsize() < LONGEST_QUEUE:
            values = ", ".join([f"{value:.2f}" for value in axes])
            self._lines.put((self._display.info, f"{self._prefix} [{values}]"))

    def info(self, line):
        """Show a line and send it to /rosout."""
        self._lines.put((rospy.loginfo, line))

    def goodbye(self, line):
        """Show a last line at once, without a question to the master.

        When a newer node of the same name has taken over, the master would take the question for
        the older one's return, and end the newer one.
        """
        self._display.info(line)

    def warn(self, line):
        """Show a warning and send it to /rosout."""
        self._lines.put((rospy.logwarn, line))

    def _show(self):
        while True:
            log, line = self._lines.get()
            with contextlib.suppress(OSError):  # the screen is gone; driving goes on
                log("%s", line)
            if self._lines.empty():
                time.sleep(GATHER_S)


def _console_logger(name):
    """A logger that shows lines as rospy does, but sends them nowhere else.

    /rosout and the log file cost many times what the whole conversion of a message costs.
    """
    rosout = logging.getLogger("rosout")
    logger = rosout.getChild(name)
    logger.propagate = False
    for handler in rosout.handlers:
        if isinstance(handler, RosStreamHandler):
            logger.addHandler(handler)
    return logger
