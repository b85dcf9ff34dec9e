#!/usr/bin/python3
"""launch_joy_node.launch virtual:=true in a terminal: keys drive the simulated robot."""

import os
import re
import subprocess
import sys
import unittest
import uuid

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry

from joy_to_twist.safety import ARMED
from tutorial_testing.waiting import wait_for

HINT = "  without LB: tap space, then this key at once"
STATE = rf"^  left stick [+-]\d\.\d [+-]\d\.\d({HINT}|  LB|  RB|  MODE LED on|  unplugged)*$"
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml


class Tmux:
    """A terminal that a program can look at and type into."""

    def __init__(self, *command):
        self._socket = f"test-{uuid.uuid4()}"
        self._run("new-session", "-d", "-x", "120", "-y", "50", *command)
        self._run("set-option", "remain-on-exit", "on")

    def _run(self, *words):
        command = ("tmux", "-f", os.devnull, "-L", self._socket, *words)
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    @property
    def screen(self):
        return self._run("capture-pane", "-p")

    @property
    def history(self):
        """All that was written, also what has left the screen."""
        return self._run("capture-pane", "-p", "-J", "-S", "-")

    @property
    def ended(self):
        return self._run("list-panes", "-F", "#{pane_dead}").strip() == "1"

    def press(self, key):
        self._run("send-keys", key)

    def hold(self, key, until, what):
        """Repeat a key as a keyboard does, until something is true."""

        def pressed():
            self.press(key)
            return until()

        try:
            wait_for(pressed, what)
        except AssertionError as error:
            raise AssertionError(f"{error}; the screen:\n{self.screen}") from None

    def close(self):
        self._run("kill-server")


class KeyboardTest(unittest.TestCase):
    def setUp(self):
        self.odometry = []
        subscriber = rospy.Subscriber("odom", Odometry, self.odometry.append)
        self.addCleanup(subscriber.unregister)
        self.device = f"/tmp/{uuid.uuid4()}"
        arguments = f"virtual:=true rviz:=false cockpit:=false joy_dev:={self.device}"
        self.terminal = Tmux(f"roslaunch joy2twist launch_joy_node.launch {arguments}")
        self.addCleanup(self.terminal.close)
        wait_for(lambda: "Opened joystick" in self.terminal.history, "driver")
        wait_for(lambda: self.odometry, "robot")
        self.states = []
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self.keep_state)
        self.addCleanup(subscriber.unregister)
        # A key pressed before joy2twist has seen the gamepad released would not drive.
        wait_for(lambda: self.states and self.states[-1] == ARMED, "armed joy2twist")

    def keep_state(self, message):
        self.states += [s.message for s in message.status if s.name.startswith("myjoystick2twist")]

    @property
    def speed(self):
        return self.odometry[-1].twist.twist.linear.x

    def moves(self):
        return abs(self.speed - SPEED) < 1e-6

    def stands(self):
        return self.speed == 0.0

    def end_with(self, key):
        self.terminal.press(key)
        wait_for(lambda: self.terminal.ended, "end of the launch")
        history = self.terminal.history
        self.assertNotIn("Traceback", history)
        self.assertNotIn("process has died", history)
        for line in history.splitlines():
            if re.search(r"left stick [+-]", line):
                self.assertRegex(line, STATE, "something is glued to the state")
        self.assertFalse(os.path.exists(self.device), "the FIFO is left")

    def test_keys_held_and_released_move_and_stop_the_robot(self):
        terminal = self.terminal
        self.assertIn("LB, the dead-man button: hold it", terminal.screen)
        shown = f"left stick +0.0 +1.0{HINT}"
        terminal.hold("w", lambda: shown in terminal.screen, "key on the screen")
        wait_for(lambda: "left stick +0.0 +0.0" in terminal.screen, "released key")
        self.assertTrue(all(m.twist.twist.linear.x == 0 for m in self.odometry), "moved without LB")

        terminal.press("Space")
        terminal.hold("Up", self.moves, "moving robot")
        self.assertIn("+1.0  LB", terminal.screen)
        wait_for(self.stands, "standing robot after the keys were released")

        terminal.press("Space")
        terminal.hold("w", self.moves, "moving robot")
        terminal.press("u")
        wait_for(self.stands, "standing robot after unplugging")
        wait_for(lambda: "unplugged" in terminal.screen, "word on the screen")
        self.end_with("q")

    def test_a_screen_that_is_held_releases_all_keys(self):
        self.terminal.press("Space")
        self.terminal.hold("w", self.moves, "moving robot")
        self.terminal.press("C-s")  # the terminal's flow control: nothing can be shown any more
        wait_for(self.stands, "standing robot on a held screen")
        count = len(self.odometry)
        self.terminal.press("Space")
        for _ in range(20):
            self.terminal.press("w")
        wait_for(lambda: len(self.odometry) > count + 50, "odometry")
        speeds = {odometry.twist.twist.linear.x for odometry in self.odometry[count:]}
        self.assertEqual(speeds, {0.0})
        self.terminal.press("C-q")
        self.end_with("q")

    def test_ctrl_c_while_driving_ends_all_with_a_standing_robot(self):
        self.terminal.press("Space")
        self.terminal.hold("w", self.moves, "moving robot")
        self.end_with("C-c")
        self.assertIn("done", self.terminal.screen)


if __name__ == "__main__":
    rospy.init_node("joystick_keyboard_test")
    rostest.rosrun("ros1_tutorial_test", "joystick_keyboard", KeyboardTest, sys.argv)
