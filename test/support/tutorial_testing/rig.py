"""A robot that is driven through every node of the suite, by hands that never release LB.

a FIFO -> joy_node -> joy2twist [-> cmd_vel_mux] -> fake_turtlebot -> /odom
"""

import json
import os
import signal
import tempfile
import time
from functools import partial
from pathlib import Path

import rospkg
import yaml

from tutorial_testing.hands import DRIVE, RELEASED, Hands
from tutorial_testing.nodes import node_path, pid_of
from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.waiting import Stopwatch

JOYSTICK, DRIVER, MUX, BASE = "/joy_node", "/NewJoy2Twist", "/cmd_vel_mux", "/fake_turtlebot"
TIMEOUT_S = 0.6  # the base's
# As in the launch files.
LAUNCHED = {"arm_on_neutral": True, "joy_timeout": 0.5, "log_rate": 0}
REST_S = 0.6  # for which all stays released, so that each node sees it


def config(package, name):
    return yaml.safe_load(Path(rospkg.RosPack().get_path(package), "config", name).read_text())


class Rig(Robot):
    """The nodes, each a program of its own; a context manager that ends them all."""

    base = BASE

    def __init__(self, with_mux=True, screen=None, **joy2twist):
        """screen: the path that the nodes write to, or None. joy2twist: more of its parameters."""
        super().__init__()
        # In the order from the hand to the wheels.
        self.nodes = [JOYSTICK, DRIVER, *([MUX] if with_mux else []), self.base]
        self._screen, self._joy2twist = screen, joy2twist
        self._velocities = "cmd_vel_mux/input/teleop" if with_mux else "cmd_vel"
        folder = self._stack.enter_context(tempfile.TemporaryDirectory())
        self._device = os.path.join(folder, "js0")
        self.hands = Hands(self._device)
        self.programs = {}

    def begin(self):
        self._stack.enter_context(self.hands)
        self._stack.callback(self._end_nodes)
        for node in self.nodes:
            self.start(node)
        self.listen()

    def _end_nodes(self):
        for program in self.programs.values():
            program.__exit__()

    def given(self, node):
        """Return (program, parameters, remaps) of a node."""
        if node == JOYSTICK:
            return [node_path("gamepad", "joy_node")], {"dev": self._device}, {}
        if node == DRIVER:
            preset = {**config("joy2twist", "f710_d.yaml"), **LAUNCHED}
            program, remaps = node_path("joy2twist", "joy2twist.py"), {"cmd_vel": self._velocities}
            return [program], {**preset, **self._joy2twist}, remaps
        simulator = partial(node_path, "fake_turtlebot_sim")
        if node == MUX:
            given = config("fake_turtlebot_sim", "cmd_vel_mux.yaml")
            return [simulator("cmd_vel_mux.py")], given, {"cmd_vel_mux/output": "cmd_vel"}
        return [simulator("fake_turtlebot.py")], {}, {}

    def start(self, node):
        program, parameters, remaps = self.given(node)
        given = [f"_{name}:={json.dumps(value)}" for name, value in parameters.items()]
        command = [*program, *given, *(f"{name}:={to}" for name, to in remaps.items())]
        if self._screen:
            command = ["bash", "-c", 'exec "$@" >"$0" 2>&1', self._screen, *command]
        old = self.programs.get(node)
        self.programs[node] = Program(*command)
        if old:
            old.__exit__()

    def kill(self, node, number=signal.SIGKILL, pid=None):
        """Send a signal to a node; return how long it took to exit [s]. pid: its own, if known."""
        pid, watch = pid or pid_of(node), Stopwatch()
        os.kill(pid, number)
        self.programs[node].wait()
        return watch.took_s

    def hold(self):
        """Release all until the robot has rested, then hold LB and the stick."""
        self.hands.show(RELEASED)
        self.wait_for_rest()
        time.sleep(REST_S)
        self.hands.show(DRIVE)

    def drive(self):
        self.drive_by(self.hold)
