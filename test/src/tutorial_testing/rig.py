"""A robot that is driven through every node of the suite, and hands that never let go of LB.

a FIFO -> joy_node -> joy2twist [-> cmd_vel_mux] -> fake_turtlebot -> /odom
"""

import json
import os
import signal
import tempfile
import threading
import time
from pathlib import Path

import rosgraph
import rospkg
import rospy
import yaml
from nav_msgs.msg import Odometry

from node_kit.questions import call
from tutorial_testing.hands import DRIVE, RELEASED, Hands
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, suspend
from tutorial_testing.waiting import wait_for

JOYSTICK, DRIVER, MUX, BASE = "/joy_node", "/NewJoy2Twist", "/cmd_vel_mux", "/fake_turtlebot"
SAFETY = "/kobuki_safety_controller"
EVENTS = ("bumper", "cliff", "wheel_drop")  # of the Kobuki
TIMEOUT_S = 0.6  # of the base
REST_S = 0.6  # for which a multiplexer wants to see a sender rest
CYCLE_S = 5.0  # to release all and drive again, at least


def given_to(node, device, with_mux=True, world="", **joy2twist):
    """Return (package, program, parameters, remaps) of a node.

    device: that joy_node reads. world: of the base. joy2twist: more parameters of joy2twist.
    """

    def config(package, name):
        path = Path(rospkg.RosPack().get_path(package), "config", name)
        return yaml.safe_load(path.read_text())

    if node == JOYSTICK:
        return "gamepad", "joy_node", {"dev": device}, {}
    if node == DRIVER:
        preset = {"arm_on_neutral": True, "log_rate": 0, **joy2twist}
        remaps = {"cmd_vel": "cmd_vel_mux/input/teleop"} if with_mux else {}
        return "joy2twist", "joy2twist.py", {**config("joy2twist", "f710_d.yaml"), **preset}, remaps
    if node == MUX:
        remaps = {"cmd_vel_mux/output": "cmd_vel"}
        given = config("fake_turtlebot_sim", "cmd_vel_mux.yaml")
        return "fake_turtlebot_sim", "cmd_vel_mux.py", given, remaps
    if node == SAFETY:
        topics = {f"~events/{kind}": f"mobile_base/events/{kind}" for kind in EVENTS}
        remaps = {"~cmd_vel": "cmd_vel_mux/input/safety_controller", **topics}
        remaps = {name.replace("~", f"{SAFETY}/"): to for name, to in remaps.items()}
        return "fake_turtlebot_sim", "safety_controller.py", {}, remaps
    return "fake_turtlebot_sim", "fake_turtlebot.py", {"world": world}, {}


def arguments(parameters, remaps):
    """Return the command-line arguments of a node."""
    given = [f"_{name}:={json.dumps(value)}" for name, value in parameters.items()]
    return given + [f"{name}:={to}" for name, to in remaps.items()]


class Rig:
    """The nodes, each a program of its own; a context manager that ends them all."""

    def __init__(self, with_mux=True, screen=None):
        """screen: path of what the nodes write their lines to; None: they are kept."""
        self.nodes = [JOYSTICK, DRIVER, *([MUX] if with_mux else []), BASE]  # from hand to wheel
        self._screen = screen
        self._folder = tempfile.TemporaryDirectory()
        self._device = os.path.join(self._folder.name, "js0")
        self._hands = Hands(self._device)
        self.programs = {}
        self.speeds = []  # (stamp [s], forward speed [m/s]) of every odometry
        self._odom = None

    def __enter__(self):
        self._hands.__enter__()
        for node in self.nodes:
            self.start(node)
        self._odom = rospy.Subscriber("odom", Odometry, self._on_odometry, queue_size=1000)
        return self

    def __exit__(self, *_):
        for program in self.programs.values():
            program.__exit__()
        self._hands.__exit__()
        if self._odom:
            self._odom.unregister()
        self._folder.cleanup()

    def start(self, node):
        """Start a node, or restart it."""
        package, name, *given = given_to(node, self._device, MUX in self.nodes)
        command = (node_path(package, name), *arguments(*given))
        if self._screen:
            command = ("bash", "-c", 'exec "$@" >"$0" 2>&1', self._screen, *command)
        self.programs[node] = Program(*command)

    def pid(self, node):
        """Return the process of a node."""

        def ask():
            uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
            return uri and call(uri, "getPid")[1]

        return wait_for(ask, f"process of {node}")

    def kill(self, node, number=signal.SIGKILL, pid=None):
        """Send a signal to a node; return how long it took to exit [s]. pid: if it is known."""
        pid = pid or self.pid(node)
        began = time.monotonic()
        os.kill(pid, number)
        self.programs[node].wait()
        return time.monotonic() - began

    def _on_odometry(self, odometry):
        twist = odometry.twist.twist
        speed = abs(twist.linear.x) + abs(twist.angular.z)
        self.speeds.append((odometry.header.stamp.to_sec(), speed))

    def is_moving(self):
        """Return whether the newest odometry says so."""
        return bool(self.speeds) and self.speeds[-1][1] > 0.0

    def drive(self):
        """Release all and hold LB and the stick, until the robot moves."""

        def once():
            self._hands.show(RELEASED)
            self.wait_for_rest()
            threading.Event().wait(REST_S)  # what a multiplexer wants to see
            self._hands.show(DRIVE)
            end = time.monotonic() + CYCLE_S
            while time.monotonic() < end and not self.is_moving():
                time.sleep(0.01)
            return self.is_moving()

        wait_for(once, "robot that drives")

    def wait_for_rest(self):
        """Wait until new odometry says that the robot stands."""
        count = len(self.speeds)
        wait_for(lambda: len(self.speeds) > count and not self.is_moving(), "robot at rest")

    def since(self, stamp):
        """Return (stamp, speed) of all odometry after a time [s]."""
        return [entry for entry in list(self.speeds) if entry[0] > stamp]


def stop(pids):
    """Suspend processes; return the time [s] just before."""
    now = time.time()
    suspend(pids)
    return now


def go_on(pids):
    """Resume suspended processes; return the time [s] just before."""
    now = time.time()
    for pid in pids:
        os.kill(pid, signal.SIGCONT)
    return now
