#!/usr/bin/python3
"""Nodes are suspended while the robot is driven: it comes to rest, and stays until released."""

import itertools
import sys
import threading
import unittest

import rostest

from tutorial_testing.nodes import init_node
from tutorial_testing.rig import BASE, TIMEOUT_S, Rig, go_on, stop
from tutorial_testing.waiting import wait_for

DURATIONS_S = (0.2, 0.5, 1.0, 3.0)
PERIOD_S = 0.02
# What a busy machine may add between a node and the next one, and to the stamps of this process.
BUSY_S = 0.3
WATCHED_S = 1.0  # after the end of the suspension


class SuspendedTest(unittest.TestCase):
    def check(self, rig, names, duration_s, pids):
        what = f"{' and '.join(names)} for {duration_s} s"
        rig.drive()
        began = stop(pids)
        threading.Event().wait(duration_s)
        ended = go_on(pids)
        wait_for(lambda: rig.since(ended + WATCHED_S), f"odometry after {what}")
        rest = began + TIMEOUT_S + PERIOD_S + BUSY_S
        if BASE in names:
            rest = max(rest, ended + BUSY_S)
        moving = [stamp - began for stamp, speed in rig.since(rest) if speed]
        self.assertEqual(moving, [], what)
        seen = rig.since(began)
        stood = next((stamp for stamp, speed in seen if speed == 0.0), None)
        again = [stamp - began for stamp, speed in seen if stood and stamp > stood and speed]
        self.assertEqual(again, [], f"{what}: moved again")

    def check_all(self, with_mux, sizes):
        with Rig(with_mux) as rig:
            pids = {node: rig.pid(node) for node in rig.nodes}
            groups = [group for size in sizes for group in itertools.combinations(rig.nodes, size)]
            for names, duration_s in itertools.product(groups, DURATIONS_S):
                self.check(rig, names, duration_s, [pids[name] for name in names])
            # No node was restarted, and all of them still do their work.
            rig.drive()
            self.assertEqual(pids, {node: rig.pid(node) for node in rig.nodes})

    def test_every_node_and_every_pair(self):
        self.check_all(True, (1, 2))

    def test_every_node_without_a_mux(self):
        self.check_all(False, (1,))


if __name__ == "__main__":
    init_node("suspended")
    rostest.rosrun("ros1_tutorial_test", "suspended", SuspendedTest, sys.argv)
