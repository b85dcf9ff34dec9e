#!/usr/bin/python3
"""The virtual gamepad is abandoned or suspended, and the robot stands."""

import subprocess
import sys
import unittest

import rostest

from tutorial_testing.keys import KeyboardRig
from tutorial_testing.nodes import init_node
from tutorial_testing.rig import go_on, stop
from tutorial_testing.waiting import wait_for

WATCHED = 50  # odometry messages, one second


class FaultsOfTheKeys(unittest.TestCase):
    def setUp(self):
        self.rig = KeyboardRig()
        self.addCleanup(self.rig.close)
        self.rig.wait_until_ready()

    def check_stays(self, what):
        """LB and W are pressed, and still nothing moves."""
        count = len(self.rig.odometry)
        self.rig.terminal.press("Space")
        for _ in range(20):
            self.rig.terminal.press("w")
        wait_for(lambda: len(self.rig.odometry) > count + WATCHED, "odometry")
        speeds = {odometry.twist.twist.linear.x for odometry in self.rig.odometry[count:]}
        self.assertEqual(speeds, {0.0}, what)

    def test_a_screen_that_is_held_releases_all_keys(self):
        terminal = self.rig.terminal
        self.rig.drive()
        terminal.press("C-s")  # the terminal's flow control: nothing can be shown any more
        wait_for(self.rig.stands, "standing robot on a held screen")
        self.check_stays("on a held screen")
        terminal.press("C-q")
        self.rig.drive()
        # It went on with its work, and was not only missed by joy_node.
        self.assertNotIn("no sign of life", terminal.history)

    def test_keys_that_were_typed_during_a_suspension_do_not_drive(self):
        serves = f"virtual_joystick.*--stream.*{self.rig.device}"
        found = subprocess.run(["pgrep", "-f", serves], check=True, capture_output=True, text=True)
        pids = [int(pid) for pid in found.stdout.split()]
        self.rig.drive()
        stop(pids)
        wait_for(self.rig.stands, "standing robot without signs of life")
        self.check_stays("while it is suspended")
        count = len(self.rig.odometry)
        go_on(pids)  # it reads what was typed meanwhile
        wait_for(lambda: len(self.rig.odometry) > count + WATCHED, "odometry")
        speeds = {odometry.twist.twist.linear.x for odometry in self.rig.odometry[count:]}
        self.assertEqual(speeds, {0.0}, "after the suspension")
        self.rig.drive()

    def test_a_terminal_that_is_closed_leaves_a_standing_robot(self):
        self.rig.drive()
        self.rig.terminal.close()
        wait_for(self.rig.stands, "standing robot without a terminal")


if __name__ == "__main__":
    init_node("keys")
    rostest.rosrun("ros1_tutorial_test", "keys", FaultsOfTheKeys, sys.argv)
