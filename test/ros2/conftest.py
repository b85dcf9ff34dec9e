"""A master, the bridge, and programs with ROS 2; this process is a node of ROS 1."""

import json
import os
import time
from contextlib import ExitStack

import pytest
import rospy
from drive import Stick, own_master
from nav_msgs.msg import Odometry

from node_kit import ros2_python
from tutorial_testing.processes import Program, command_line, descendants
from tutorial_testing.waiting import wait_for

SIDES = {"ROS 1": "ros2_bridge.ros1_node", "ROS 2": "ros2_side.py"}


def pytest_addoption(parser):
    """Of test_faults.py: how many trials, and the seed of the first."""
    parser.addoption("--trials", type=int, default=3, metavar="N")
    parser.addoption("--seed", type=int, default=1)


@pytest.fixture(scope="session", autouse=True)
def master():
    with own_master():
        yield


@pytest.fixture
def start():
    """start(words): a program that ends with the test."""
    with ExitStack() as stack:

        def begin(*words):
            program = stack.enter_context(Program(*map(str, words)))
            stack.callback(end, program)
            return program

        yield begin


def end(program):
    if not program.ended:
        program.interrupt()
        program.wait()


@pytest.fixture
def start_ros2(start):
    """start_ros2(file, ...): a Python program with ROS 2."""
    return lambda *words: start(*ros2_python.command([str(word) for word in words]))


class Bridge:
    """The bridge, and which of its processes is which."""

    def __init__(self, program):
        self.program = program
        wait_for(self.is_up, "both sides of the bridge")

    @property
    def output(self):
        return self.program.output

    def process(self, side):
        """The id of a side's process; None if it does not run."""
        pids = descendants(self.program.pid)[1:]
        return next((pid for pid in pids if SIDES[side] in command_line(pid)), None)

    def is_up(self):
        assert not self.program.ended, self.output
        return all(map(self.process, SIDES))

    def send(self, side, number):
        """Send a signal to a side; return its process."""
        pid = self.process(side)
        os.kill(pid, number)
        return pid


@pytest.fixture
def bridge(start, tmp_path):
    """bridge({topic: direction}): a Bridge that carries these, or those of our own list."""

    def begin(topics=None):
        given, file = [], tmp_path / "topics.yaml"
        if topics:
            listed = {topic: {"direction": direction} for topic, direction in topics.items()}
            file.write_text(json.dumps({"topics": listed}))
            given = [f"_topics:={file}"]
        return Bridge(start("rosrun", "ros2_bridge", "bridge", *given))

    return begin


class Ear:
    """What comes on a topic of ROS 1: (when, node, message)."""

    def __init__(self):
        self.heard = []

    def keep(self, message):
        sender = message._connection_header["callerid"]
        self.heard.append((time.monotonic(), sender, message))

    @property
    def last(self):
        return self.heard[-1][2] if self.heard else None


@pytest.fixture
def ear():
    """ear(topic, kind): an Ear."""
    with ExitStack() as stack:

        def listen(topic, kind):
            made = Ear()
            stack.callback(rospy.Subscriber(topic, kind, made.keep, tcp_nodelay=True).unregister)
            return made

        yield listen


@pytest.fixture
def stick():
    made = Stick()
    yield made
    made.end()
    made._publisher.unregister()


@pytest.fixture
def robot(start, ear):
    """What the simulated robot's odometry says."""
    odometry = ear("/odom", Odometry)
    start("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py")
    wait_for(lambda: odometry.heard, "odometry")
    return odometry
