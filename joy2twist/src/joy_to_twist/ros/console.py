"""What the node shows to its user."""

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

# A bag's messages that come at log_rate, but not quite evenly, and a few at once, all pass.
BURST_S = 0.2


class Console(Log):
    """A Log that also displays joystick messages, some tens a second."""

    def __init__(self, log_rate: float) -> None:
        """Take how many messages a second are displayed at most."""
        super().__init__()
        self._may_display = Throttle(log_rate, burst=max(1.0, log_rate * BURST_S))
        self._prefix = f"{rospy.get_name()}: Get from Joy"

    def display(self, axes: Sequence[float], now: float) -> None:
        """Show the axes of a joystick message, as the tutorial does."""
        if self._may_display.ready(now):
            self.put(self._show_axes, axes)

    def goodbye(self, line: str) -> None:
        """Show a last line at once, without a question to the master.

        The master would take that for this node's return, and end one that has taken over.
        """
        with contextlib.suppress(OSError):
            _write([line])

    def _show_axes(self, messages: list[Sequence[float]]) -> None:
        texts = [", ".join(["%.2f"] * len(axes)) % axes for axes in messages]
        _write([f"{self._prefix} [{text}]" for text in texts])


def _write(lines: list[str]) -> None:
    """Write lines as rospy.loginfo does to the screen, which takes longer than all else."""
    if rospy.rostime.is_wallclock() and "ROSCONSOLE_FORMAT" not in os.environ:
        # What RosStreamHandler makes of each: its search for every tag costs ten times as much.
        sys.stdout.write("".join([f"[INFO] [{time.time():f}]: {line}\n" for line in lines]))
    else:
        screen = RosStreamHandler(colorize=False)
        for line in lines:
            screen.emit(logging.LogRecord("rosout.joy", logging.INFO, __file__, 0, line, (), None))
    sys.stdout.flush()
