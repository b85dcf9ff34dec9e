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

from gamepad.gamepads import F710_D
from gamepad.virtual.controls import Controls, positions
from gamepad.virtual.pads import StreamPad
from node_kit.questions import call
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, suspend
from tutorial_testing.waiting import wait_for

JOYSTICK, DRIVER, MUX, BASE = "/joy_node", "/NewJoy2Twist", "/cmd_vel_mux", "/fake_turtlebot"
TIMEOUT_S = 0.6  # of the base
REST_S = 0.6  # for which a multiplexer wants to see a sender rest
HANDS_S = 0.05  # how often the hands move
CYCLE_S = 5.0  # to release all and drive again, at least


class Rig:
    """The nodes, each a program of its own; a context manager that ends them all."""

    def __init__(self, with_mux, screen=None, **environment):
        """screen: path of what the nodes write their lines to; None: they are kept."""
        self.with_mux = with_mux
        self._screen = screen
        self._environment = environment
        self._folder = tempfile.TemporaryDirectory()
        self._fifo = os.path.join(self._folder.name, "js0")
        self.programs = {}
        self.speeds = []  # (stamp [s], forward speed [m/s]) of every odometry
        self._odom = None
        self._driving = False
        self._done = threading.Event()
        self._hands = threading.Thread(target=self._move, daemon=True)

    @property
    def nodes(self):
        """The names of the nodes, from the joystick to the base."""
        return [JOYSTICK, DRIVER, *([MUX] if self.with_mux else []), BASE]

    def __enter__(self):
        self._hands.start()
        for node in self.nodes:
            self.start(node)
        self._odom = rospy.Subscriber("odom", Odometry, self._on_odometry, queue_size=1000)
        return self

    def __exit__(self, *_):
        self._done.set()
        for program in self.programs.values():
            program.__exit__()
        self._hands.join()
        if self._odom:
            self._odom.unregister()
        self._folder.cleanup()

    def start(self, node):
        """Start a node, or start it anew."""
        joy2twist = Path(rospkg.RosPack().get_path("joy2twist"))
        simulator = Path(rospkg.RosPack().get_path("fake_turtlebot_sim"))
        preset = yaml.safe_load((joy2twist / "config" / "f710_d.yaml").read_text())
        preset.update(arm_on_neutral=True, log_rate=0)
        mux = yaml.safe_load((simulator / "config" / "cmd_vel_mux.yaml").read_text())
        command, given, remap = {
            JOYSTICK: (("gamepad", "joy_node"), {"dev": self._fifo}, {}),
            DRIVER: (
                ("joy2twist", "joy2twist.py"),
                preset,
                {"cmd_vel": "cmd_vel_mux/input/teleop"} if self.with_mux else {},
            ),
            MUX: (
                ("fake_turtlebot_sim", "cmd_vel_mux.py"),
                mux,
                {"cmd_vel_mux/output": "cmd_vel"},
            ),
            BASE: (("fake_turtlebot_sim", "fake_turtlebot.py"), {}, {}),
        }[node]
        arguments = [f"_{name}:={json.dumps(value)}" for name, value in given.items()]
        arguments += [f"{name}:={to}" for name, to in remap.items()]
        command = (node_path(*command), *arguments)
        if self._screen:
            command = ("bash", "-c", 'exec "$@" >"$0" 2>&1', self._screen, *command)
        self.programs[node] = Program(*command, **self._environment)

    def pid(self, node):
        """The process of a node."""

        def ask():
            uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
            return uri and call(uri, "getPid")[1]

        return wait_for(ask, f"process of {node}")

    def _on_odometry(self, odometry):
        twist = odometry.twist.twist
        speed = abs(twist.linear.x) + abs(twist.angular.z)
        self.speeds.append((odometry.header.stamp.to_sec(), speed))

    def _move(self):
        """Keep the stick moving, so that nothing is still for a reason of its own."""
        with StreamPad(F710_D, self._fifo) as pad:
            nudge = 0.0
            while not self._done.wait(HANDS_S):
                nudge = 0.1 - nudge
                if self._driving:
                    controls = Controls(left_stick=(0.0, 0.9 + nudge), held=frozenset({"LB"}))
                else:
                    controls = Controls()
                pad.show(positions(F710_D, controls))

    def hold(self):
        """LB and the stick, from now on."""
        self._driving = True

    def release(self):
        """Nothing any more."""
        self._driving = False

    def is_moving(self):
        """Whether the newest odometry says so."""
        return bool(self.speeds) and self.speeds[-1][1] > 0.0

    def drive(self):
        """Release all and hold LB and the stick, until the robot moves."""

        def once():
            self.release()
            self.wait_for_rest()
            threading.Event().wait(REST_S)  # what a multiplexer wants to see
            self.hold()
            end = time.monotonic() + CYCLE_S
            while time.monotonic() < end and not self.is_moving():
                time.sleep(0.01)
            return self.is_moving()

        wait_for(once, "robot that drives")

    def wait_for_rest(self):
        """Until new odometry says that the robot stands."""
        count = len(self.speeds)
        wait_for(lambda: len(self.speeds) > count and not self.is_moving(), "robot at rest")

    def since(self, stamp):
        """(stamp, speed) of all odometry after a time [s]."""
        return [entry for entry in list(self.speeds) if entry[0] > stamp]


def stop(pids):
    """Suspend processes; the time [s] just before."""
    now = time.time()
    suspend(pids)
    return now


def go_on(pids):
    """Let suspended processes go on; the time [s] just before."""
    now = time.time()
    for pid in pids:
        os.kill(pid, signal.SIGCONT)
    return now
