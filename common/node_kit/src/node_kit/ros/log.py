"""Lines for the user, shown by a separate thread.

rospy calls the master for every line, and a user can stop the output with Ctrl-S: a callback that
logs through rospy can block forever.
"""

from __future__ import annotations

import contextlib
import itertools
import queue
import threading
import time
from operator import itemgetter
from typing import Any, Callable, List

import rospy

# Lines within this time are shown together, which costs less than to wake a thread for each.
GATHER_S = 0.25
LONGEST_QUEUE = 1000  # lines that are kept while the output is blocked; later lines are lost
Show = Callable[[List[Any]], object]


class Log:
    """Shows lines, and sends them to /rosout, without waiting. The node must be initialised."""

    def __init__(self) -> None:
        self._waiting: queue.SimpleQueue[tuple[Show, Any]] = queue.SimpleQueue()
        threading.Thread(target=self._show, daemon=True).start()

    def info(self, line: str) -> None:
        """Show a line."""
        self.put(self._info, line)

    def warn(self, line: str) -> None:
        """Show a warning."""
        self.put(self._warn, line)

    def error(self, line: str) -> None:
        """Show an error."""
        self.put(self._error, line)

    def put(self, show: Show, content: Any) -> None:
        """Call show([content, ...]) soon, with all that is put for it until then."""
        if self._waiting.qsize() < LONGEST_QUEUE:
            self._waiting.put((show, content))

    def _show(self) -> None:
        while True:
            together = [self._waiting.get()]
            while not self._waiting.empty():
                together.append(self._waiting.get())
            for show, group in itertools.groupby(together, key=itemgetter(0)):
                with contextlib.suppress(OSError):  # the terminal is closed; the node goes on
                    show([content for _, content in group])
            time.sleep(GATHER_S)

    def _info(self, lines: list[str]) -> None:
        for line in lines:
            rospy.loginfo("%s", line)

    def _warn(self, lines: list[str]) -> None:
        for line in lines:
            rospy.logwarn("%s", line)

    def _error(self, lines: list[str]) -> None:
        for line in lines:
            rospy.logerr("%s", line)
