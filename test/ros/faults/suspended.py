#!/usr/bin/python3
"""Nodes are suspended while the robot is driven: it comes to rest, and stays until released."""

import itertools
import sys
import threading
import unittest

import rospy
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
        moving = [stamp for stamp, speed in rig.since(rest) if speed]
        if moving:
            self.failures.append(f"{what}: moved {moving[-1] - began:.2f} s after its begin")
        stood = False
        for stamp, speed in rig.since(began):
            stood = stood or speed == 0.0
            if stood and speed:
                self.failures.append(f"{what}: moved again {stamp - began:.2f} s after its begin")
                return

    def test_every_node_and_every_pair(self):
        self.failures = []
        with Rig(with_mux=rospy.get_param("~with_mux")) as rig:
            pids = {node: rig.pid(node) for node in rig.nodes}
            groups = [(node,) for node in rig.nodes] + list(itertools.combinations(rig.nodes, 2))
            for names, duration_s in itertools.product(groups, DURATIONS_S):
                self.check(rig, names, duration_s, [pids[name] for name in names])
            # Nobody was started anew, and all of them still do their work.
            rig.drive()
            self.assertEqual(pids, {node: rig.pid(node) for node in rig.nodes})
        self.assertEqual(self.failures, [])


if __name__ == "__main__":
    init_node("suspended")
    rostest.rosrun("ros1_tutorial_test", "suspended", SuspendedTest, sys.argv)
