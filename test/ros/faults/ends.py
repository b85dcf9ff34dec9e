#!/usr/bin/python3
"""Every node ends in time, a base at rest first, whatever the peers and the screen do."""

import contextlib
import os
import signal
import sys
import tempfile
import time
import unittest
from pathlib import Path

import rostest

from tutorial_testing.nodes import init_node
from tutorial_testing.rig import BASE, Rig, go_on, stop
from tutorial_testing.waiting import BUSY_S, wait_for

LONGEST_END_S = 1.5 + BUSY_S


@contextlib.contextmanager
def held_screen():
    """A path that can be written to, and has no room: so is a terminal after Ctrl-S."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "screen"
        os.mkfifo(path)
        descriptor = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        try:
            for size in (4096, 1):  # what is left of the last page, too
                with contextlib.suppress(BlockingIOError):
                    while True:
                        os.write(descriptor, b"." * size)
            yield str(path)
        finally:
            os.close(descriptor)


class FaultsAtTheEnd(unittest.TestCase):
    def check_end(self, rig, node, number):
        """The node is gone in time, and the robot stands."""
        pid = rig.pid(node)
        began = time.monotonic()
        os.kill(pid, number)
        rig.programs[node].wait()
        self.assertLess(time.monotonic() - began, LONGEST_END_S, node)
        wait_for(lambda: not rig.is_moving(), f"robot at rest after the end of {node}")

    def check_held_screen(self, number):
        with held_screen() as screen, Rig(with_mux=True, screen=screen) as rig:
            for node in rig.nodes:
                rig.drive()
                self.check_end(rig, node, number)
                if node != BASE:
                    rig.start(node)

    def test_a_held_screen_and_sigint(self):
        self.check_held_screen(signal.SIGINT)

    def test_a_held_screen_and_sigterm(self):
        self.check_held_screen(signal.SIGTERM)

    def test_peers_that_are_suspended(self):
        with Rig(with_mux=True) as rig:
            for node in rig.nodes:
                rig.drive()
                others = [rig.pid(other) for other in rig.nodes if other != node]
                stop(others)
                try:
                    pid = rig.pid(node)
                    began = time.monotonic()
                    os.kill(pid, signal.SIGINT)
                    rig.programs[node].wait()
                    self.assertLess(time.monotonic() - began, LONGEST_END_S, node)
                finally:
                    go_on(others)
                wait_for(lambda: not rig.is_moving(), f"robot at rest after the end of {node}")
                if node != BASE:
                    rig.start(node)


if __name__ == "__main__":
    init_node("ends")
    rostest.rosrun("ros1_tutorial_test", "ends", FaultsAtTheEnd, sys.argv)
