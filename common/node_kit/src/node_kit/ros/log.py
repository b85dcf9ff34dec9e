"""Lines for the user, from a thread of their own.

rospy asks the master a question for every line, and a screen may be held with Ctrl-S: a callback
that logs through rospy may wait without end.
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

GATHER_S = 0.25  # lines within this time are shown together: to wake a thread for each costs more
LONGEST_QUEUE = 1000  # lines kept while a screen or a master is held; later ones are lost
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
        """Have show([content, ...]) called with this and what else came for it meanwhile."""
        if self._waiting.qsize() < LONGEST_QUEUE:
            self._waiting.put((show, content))

    def _show(self) -> None:
        while True:
            together = [self._waiting.get()]
            while not self._waiting.empty():
                together.append(self._waiting.get())
            for show, group in itertools.groupby(together, key=itemgetter(0)):
                with contextlib.suppress(OSError):  # the screen is gone; the node goes on
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
