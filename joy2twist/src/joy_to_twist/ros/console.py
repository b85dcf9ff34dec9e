"""The lines that the node shows to its user."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import time
from typing import Sequence

import rospy
from rosgraph.roslogging import RosStreamHandler

from node_kit.ros.log import Log
from node_kit.rules.throttle import Throttle

# Messages of a bag that arrive at log_rate, but unevenly or a few at once, are all displayed.
BURST_S = 0.2


class Console(Log):
    """A Log that also displays joystick messages."""

    def __init__(self, log_rate: float) -> None:
        """Take the largest number of messages a second to display."""
        super().__init__()
        self._may_display = Throttle(log_rate, burst=max(1.0, log_rate * BURST_S))
        self._prefix = f"{rospy.get_name()}: Get from Joy"

    def display(self, axes: Sequence[float], now: float) -> None:
        """Show the axes of a joystick message, as in the tutorial."""
        if self._may_display.ready(now):
            self.put(self._show_axes, axes)

    def goodbye(self, line: str) -> None:
        """Show a last line at once, without a call to the master.

        To the master, a call is a return of this node, and it ends the node that has replaced it.
        """
        with contextlib.suppress(OSError):
            _write([line])

    def _show_axes(self, messages: list[Sequence[float]]) -> None:
        texts = [", ".join(["%.2f"] * len(axes)) % axes for axes in messages]
        _write([f"{self._prefix} [{text}]" for text in texts])


def _write(lines: list[str]) -> None:
    """Write lines to the screen as rospy.loginfo does."""
    if rospy.rostime.is_wallclock() and "ROSCONSOLE_FORMAT" not in os.environ:
        # The same text as from RosStreamHandler, whose search for tags takes ten times as long.
        sys.stdout.write("".join([f"[INFO] [{time.time():f}]: {line}\n" for line in lines]))
    else:
        screen = RosStreamHandler(colorize=False)
        for line in lines:
            screen.emit(logging.LogRecord("rosout.joy", logging.INFO, __file__, 0, line, (), None))
    sys.stdout.flush()
