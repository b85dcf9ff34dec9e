"""A master, the bridge, and programs with ROS 2; this process is a node of ROS 1."""

import os
import time

import pytest
import rospy
from drive import Stick
from nav_msgs.msg import Odometry

from node_kit import ros2_python
from tutorial_testing.nodes import init_node
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program, command_line, descendants
from tutorial_testing.waiting import wait_for

SIDES = {"ROS 1": "ros2_bridge.ros1_node", "ROS 2": "ros2_side.py"}


def pytest_addoption(parser):
    """Of test_faults.py: how many trials, and the seed of the first."""
    parser.addoption("--trials", type=int, default=3, metavar="N")
    parser.addoption("--seed", type=int, default=1)


@pytest.fixture(scope="session", autouse=True)
def master():
    """A master and a domain of ROS 2 for this test alone."""
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    os.environ["ROS_DOMAIN_ID"] = str(1 + port % 100)
    with Program("roscore", "-p", str(port)) as core:
        wait_for(lambda: "started core service" in core.output, "master")
        init_node("test", disable_signals=True)
        yield
        rospy.signal_shutdown("the end")


@pytest.fixture(autouse=True)
def own_parameters():
    """Remove a test's parameters: launch_bag.launch has a robot that never stops by itself."""
    before = set(rospy.get_param_names())
    yield
    for name in set(rospy.get_param_names()) - before:
        rospy.delete_param(name)


@pytest.fixture
def start():
    """start(words): a program that ends with the test."""
    running = []

    def begin(*words):
        running.append(Program(*map(str, words)))
        return running[-1]

    yield begin
    for program in reversed(running):
        if not program.ended:
            program.interrupt()
            program.wait()
        program.__exit__()


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
def bridge(start):
    """bridge(topics=FILE): a Bridge that carries."""

    def begin(topics=None):
        given = [f"_topics:={topics}"] if topics else []
        return Bridge(start("rosrun", "ros2_bridge", "bridge", *given))

    return begin


class Ear:
    """What comes on a topic of ROS 1: (when, node, message)."""

    def __init__(self, topic, kind):
        self.heard = []
        self._subscriber = rospy.Subscriber(topic, kind, self._keep, tcp_nodelay=True)

    def _keep(self, message):
        sender = message._connection_header["callerid"]
        self.heard.append((time.monotonic(), sender, message))

    @property
    def last(self):
        return self.heard[-1][2] if self.heard else None

    def end(self):
        self._subscriber.unregister()


@pytest.fixture
def ear():
    """ear(topic, kind): an Ear."""
    made = []

    def listen(topic, kind):
        made.append(Ear(topic, kind))
        return made[-1]

    yield listen
    for each in made:
        each.end()


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
