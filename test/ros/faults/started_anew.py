#!/usr/bin/python3
"""A part is killed and started anew while LB is held: nothing moves before the release."""

import os
import signal
import sys
import threading
import unittest

import rostest

from tutorial_testing.nodes import init_node
from tutorial_testing.rig import BASE, DRIVER, MUX, Rig, go_on, stop
from tutorial_testing.waiting import wait_for

WATCHED_S = 1.5  # in which nothing may move


class FaultsOfTheRobot(unittest.TestCase):
    """Through all nodes, with LB held."""

    def check_stays(self, rig, what):
        """The robot stands, although LB is held, until all is released."""
        rig.wait_for_rest()
        began = rig.speeds[-1][0]
        wait_for(lambda: rig.since(began + WATCHED_S), f"odometry after {what}")
        moved = [stamp - began for stamp, speed in rig.since(began) if speed]
        self.assertEqual(moved, [], what)
        rig.drive()

    def kill(self, rig, node):
        pid = rig.pid(node)
        os.kill(pid, signal.SIGKILL)
        rig.programs[node].wait()

    def test_a_robot_or_mux_that_is_started_anew_waits_for_the_release(self):
        with Rig(with_mux=True) as rig:
            for node in (MUX, BASE):
                rig.drive()
                self.kill(rig, node)
                rig.start(node)
                rig.pid(node)
                self.check_stays(rig, f"{node} was started anew")

    def test_the_same_without_a_mux(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            self.kill(rig, BASE)
            rig.start(BASE)
            rig.pid(BASE)
            self.check_stays(rig, "the robot was started anew")

    def test_joy2twist_that_is_started_anew_waits_for_the_release(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            self.kill(rig, DRIVER)
            rig.start(DRIVER)
            rig.pid(DRIVER)
            self.check_stays(rig, "joy2twist was started anew")

    def test_a_suspended_base_obeys_no_stale_command(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            base, driver = rig.pid(BASE), rig.pid(DRIVER)
            stop([base])
            threading.Event().wait(1.0)
            os.kill(driver, signal.SIGKILL)
            rig.programs[DRIVER].wait()
            threading.Event().wait(1.0)
            ended = go_on([base])
            wait_for(lambda: rig.since(ended + WATCHED_S), "odometry")
            # The first odometry may still tell of the time before.
            moved = [stamp - ended for stamp, speed in rig.since(ended + 0.1) if speed]
            self.assertEqual(moved, [])


if __name__ == "__main__":
    init_node("started_anew")
    rostest.rosrun("ros1_tutorial_test", "started_anew", "__main__", sys.argv)
