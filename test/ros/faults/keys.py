#!/usr/bin/python3
"""Nobody is at the virtual gamepad any more, and the robot stands."""

import subprocess
import sys
import tempfile
import unittest
import uuid
from pathlib import Path

import rospy
import rostest
from nav_msgs.msg import Odometry

from tutorial_testing.keys import KeyboardRig
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
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


class FaultsOfTheScript(unittest.TestCase):
    def test_a_gamepad_that_is_suspended_with_its_stick_held_is_lost(self):
        """By a script, which holds the stick for longer than any key is held."""
        speeds = []
        odom = rospy.Subscriber("odom", Odometry, lambda o: speeds.append(o.twist.twist.linear.x))
        self.addCleanup(odom.unregister)
        device = f"/tmp/{uuid.uuid4()}"
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder) / "script.yaml"
            script.write_text(SCRIPT)
            gamepad = (node_path("gamepad", "virtual_joystick"), "--stream", device, "--loop")
            launch = ("launch_joy_node.launch", "rviz:=false", f"joy_dev:={device}")
            with Program("roslaunch", "joy2twist", *launch), Program(
                *gamepad, "--script", str(script)
            ) as held:
                wait_for(lambda: speeds and speeds[-1], "robot that drives")
                pids = held.left_behind()
                stop(pids)
                try:
                    wait_for(lambda: not speeds[-1], "robot at rest without signs of life")
                finally:
                    go_on(pids)


SCRIPT = """
mode: D
moves:
  - {for: 2.0}
  - {for: 10.0, held: [LB], left_stick: [0.0, 1.0]}
"""


if __name__ == "__main__":
    init_node("keys")
    rostest.rosrun("ros1_tutorial_test", "keys", "__main__", sys.argv)
