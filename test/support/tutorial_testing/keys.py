"""A terminal in which launch_joy_node.launch virtual:=true runs: its keys drive the robot."""

import os
import subprocess
import uuid

import rospy
from diagnostic_msgs.msg import DiagnosticArray

from joy_to_twist.states import State
from tutorial_testing.processes import lives
from tutorial_testing.robot import Robot
from tutorial_testing.waiting import wait_for

LAUNCH = ("roslaunch", "joy2twist", "launch_joy_node.launch", "rviz:=false", "cockpit:=false")
SPEED = 0.35  # [m/s] at full deflection, config/f710_d.yaml


class Tmux:
    """A terminal that a program can look at and type into."""

    def __init__(self, *command):
        self._socket = f"test-{uuid.uuid4()}"
        self._run("new-session", "-d", "-x", "120", "-y", "50", *command)
        self._run("set-option", "remain-on-exit", "on")
        self._pid = self._run("list-panes", "-F", "#{pane_pid}").strip()

    def _run(self, *words, check=True):
        command = ("tmux", "-f", os.devnull, "-L", self._socket, *words)
        return subprocess.run(command, check=check, capture_output=True, text=True).stdout

    @property
    def screen(self):
        return self._run("capture-pane", "-p")

    @property
    def history(self):
        """All output, including lines that have left the screen."""
        return self._run("capture-pane", "-p", "-J", "-S", "-")

    @property
    def ended(self):
        return self._run("list-panes", "-F", "#{pane_dead}").strip() == "1"

    def press(self, key):
        self._run("send-keys", key)

    def hold(self, key, until, what):
        """Repeat a key as a keyboard does, until until() is true."""
        wait_for(lambda: self.press(key) or until(), what, seen=lambda: self.screen)

    def close(self):
        """Close it, as a window's X does; return when its programs have exited."""
        self._run("kill-server", check=False)
        wait_for(lambda: not lives(self._pid), "end of what ran in the terminal")


class DiagnosedRobot(Robot):
    """The robot of launch_joy_node.launch, and the states of its joy2twist."""

    def __init__(self):
        super().__init__()
        self._states = []

    def begin(self):
        self.listen()
        diagnostics = rospy.Subscriber("/diagnostics", DiagnosticArray, self._keep_state)
        self._stack.callback(diagnostics.unregister)

    def _keep_state(self, message):
        self._states += [s.message for s in message.status if s.name.startswith("myjoystick2twist")]

    def wait_for_state(self, state):
        """Wait until the robot runs, and joy2twist reports a state."""
        wait_for(lambda: self.odometry, "robot")
        wait_for(lambda: self._states and self._states[-1] == state, f"joy2twist that is {state}")


class KeyboardRig(DiagnosedRobot):
    """The launch in its terminal, ready to be driven."""

    def begin(self):
        super().begin()
        self.device = f"/tmp/{uuid.uuid4()}"
        self.terminal = Tmux(" ".join([*LAUNCH, "virtual:=true", f"joy_dev:={self.device}"]))
        self._stack.callback(self.terminal.close)
        wait_for(lambda: "Opened joystick" in self.terminal.history, "driver")
        # A key that is pressed before the gamepad was seen released would not drive.
        self.wait_for_state(State.ARMED.value)

    def drive(self):
        """Hold LB and W until the robot moves; LB again and again, as W may come late."""

        def moves():
            self.terminal.press("Space")
            return abs(self.now.v - SPEED) < 1e-6

        self.terminal.hold("w", moves, "moving robot")
