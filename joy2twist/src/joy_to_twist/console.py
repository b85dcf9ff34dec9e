"""What the node shows to its user."""

import contextlib
import io
import itertools
import logging
import queue
import sys
import threading
import time
from operator import itemgetter

import rospy
from node_kit.throttle import Throttle
from rosgraph.roslogging import RosStreamHandler

BURST_S = 0.1  # lets every message of a bag through that comes at log_rate, but not quite evenly
GATHER_S = 0.25  # lines within this time are shown together: to wake a thread for each costs more
LONGEST_QUEUE = 1000  # lines kept for a screen that is held


class Console:
    """Shows lines from a thread of its own, so that driving never waits for a screen or a master.

    rospy asks the master a question for every line that it logs, and a screen may be held.
    """

    def __init__(self, log_rate):
        """log_rate: how many messages a second are displayed at most."""
        self._waiting = queue.SimpleQueue()  # (the method that shows it, what is to be shown)
        self._may_display = Throttle(log_rate, burst=max(1.0, log_rate * BURST_S))
        self._prefix = f"{rospy.get_name()}: Get from Joy"
        threading.Thread(target=self._show, daemon=True).start()

    def display(self, axes, now):
        """Show the axes of a joystick message, as the tutorial does."""
        if self._may_display.ready(now) and self._waiting.qsize() < LONGEST_QUEUE:
            self._waiting.put((self._show_axes, axes))

    def info(self, line):
        """Show a line and send it to /rosout."""
        self._waiting.put((self._log_info, line))

    def warn(self, line):
        """Show a warning and send it to /rosout."""
        self._waiting.put((self._log_warnings, line))

    def goodbye(self, line):
        """Show a last line at once, without a question to the master.

        When a newer node of the same name has taken over, the master would take the question for
        the older one's return, and end the newer one.
        """
        with contextlib.suppress(OSError):
            _write([line])

    def _show(self):
        while True:
            together = [self._waiting.get()]
            while not self._waiting.empty():
                together.append(self._waiting.get())
            for show, group in itertools.groupby(together, key=itemgetter(0)):
                with contextlib.suppress(OSError):  # the screen is gone; driving goes on
                    show([content for _, content in group])
            time.sleep(GATHER_S)

    def _show_axes(self, messages):
        texts = [", ".join(["%.2f"] * len(axes)) % axes for axes in messages]
        _write([f"{self._prefix} [{text}]" for text in texts])

    def _log_info(self, lines):
        for line in lines:
            rospy.loginfo("%s", line)

    def _log_warnings(self, lines):
        for line in lines:
            rospy.logwarn("%s", line)


def _write(lines):
    """Write lines as rospy.loginfo does, but nowhere else and with one look at ROSCONSOLE_FORMAT.

    To have rospy log each one costs more than the whole conversion of a message.
    """
    mark = "\0"
    around = io.StringIO()
    record = logging.LogRecord("rosout.joy", logging.INFO, __file__, 0, mark, (), None)
    RosStreamHandler(colorize=False, stdout=around).emit(record)
    sys.stdout.write("".join([around.getvalue().replace(mark, line) for line in lines]))
    sys.stdout.flush()
