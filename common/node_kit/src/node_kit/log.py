"""Lines for the user, from a thread of their own.

rospy asks the master a question for every line that it logs, and a screen may be held: a callback
that logs may wait for ever. Here it never does.
"""

import contextlib
import itertools
import queue
import threading
import time
from operator import itemgetter

import rospy

GATHER_S = 0.25  # lines within this time are shown together: to wake a thread for each costs more
LONGEST_QUEUE = 1000  # lines kept for a screen or a master that is held; what comes after is lost


class Log:
    """Shows lines, and sends them to /rosout, without ever waiting."""

    def __init__(self):
        """The node must be initialised."""
        self._waiting = queue.SimpleQueue()  # (the method that shows it, what is to be shown)
        threading.Thread(target=self._show, daemon=True).start()

    def info(self, line):
        """Show a line."""
        self.put(self._info, line)

    def warn(self, line):
        """Show a warning."""
        self.put(self._warn, line)

    def put(self, show, content):
        """Have show([content, ...]) called with this and what else came for it meanwhile."""
        if self._waiting.qsize() < LONGEST_QUEUE:
            self._waiting.put((show, content))

    def _show(self):
        while True:
            together = [self._waiting.get()]
            while not self._waiting.empty():
                together.append(self._waiting.get())
            for show, group in itertools.groupby(together, key=itemgetter(0)):
                with contextlib.suppress(OSError):  # the screen is gone; the node goes on
                    show([content for _, content in group])
            time.sleep(GATHER_S)

    def _info(self, lines):
        for line in lines:
            rospy.loginfo("%s", line)

    def _warn(self, lines):
        for line in lines:
            rospy.logwarn("%s", line)
