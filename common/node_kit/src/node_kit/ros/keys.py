"""Reads keys from a terminal or a pipe."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from collections.abc import Iterator

import rospy

PERIOD_S = 0.1


def keys() -> Iterator[bytes]:
    """Yield the byte of each pressed key, and b"" after each PERIOD_S without a key, until the node
    or standard input ends.
    """
    terminal = sys.stdin.fileno()
    before = termios.tcgetattr(terminal) if os.isatty(terminal) else None
    try:
        if before:
            tty.setcbreak(terminal)
        while not rospy.is_shutdown():
            is_ready = select.select([terminal], [], [], PERIOD_S)[0]
            key = os.read(terminal, 1) if is_ready else b""
            if is_ready and not key:
                return
            yield key
    finally:
        if before:
            termios.tcsetattr(terminal, termios.TCSADRAIN, before)
