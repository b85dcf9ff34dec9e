#!/usr/bin/python3
"""A part is killed and restarted while LB is held: nothing moves before the release."""

import sys
import threading
import unittest

import rostest

from tutorial_testing.nodes import init_node
from tutorial_testing.rig import BASE, DRIVER, MUX, Rig, go_on, stop
from tutorial_testing.waiting import wait_for

WATCHED_S = 1.5  # in which nothing may move


class FaultsOfTheRobot(unittest.TestCase):
    def check_restart(self, with_mux, nodes):
        """The robot stands after each restart, although LB is held, until all is released."""
        with Rig(with_mux) as rig:
            for node in nodes:
                rig.drive()
                rig.kill(node)
                rig.start(node)
                rig.pid(node)
                rig.wait_for_rest()
                began = rig.speeds[-1][0]
                wait_for(lambda began=began: rig.since(began + WATCHED_S), "odometry")
                moved = [stamp - began for stamp, speed in rig.since(began) if speed]
                self.assertEqual(moved, [], node)
            rig.drive()

    def test_a_mux_or_robot_that_is_restarted_waits_for_the_release(self):
        self.check_restart(True, (MUX, BASE))

    def test_joy2twist_or_a_robot_without_a_mux_that_is_restarted_waits_for_the_release(self):
        self.check_restart(False, (DRIVER, BASE))

    def test_a_suspended_base_obeys_no_stale_command(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            base, driver = rig.pid(BASE), rig.pid(DRIVER)
            stop([base])
            threading.Event().wait(1.0)
            rig.kill(DRIVER, pid=driver)
            threading.Event().wait(1.0)
            ended = go_on([base])
            wait_for(lambda: rig.since(ended + WATCHED_S), "odometry")
            # The first odometry may still be of the time before.
            moved = [stamp - ended for stamp, speed in rig.since(ended + 0.1) if speed]
            self.assertEqual(moved, [])


if __name__ == "__main__":
    init_node("started_anew")
    rostest.rosrun("ros1_tutorial_test", "started_anew", "__main__", sys.argv)
