"""A master, the bridge, and programs with ROS 2; this process is a node of ROS 1."""

import json
from contextlib import ExitStack

import pytest
import rospy
from drive import Bridge, Stick, own_master

from node_kit import ros2_python
from tutorial_testing.processes import Program


def pytest_addoption(parser):
    """Add the options of test_faults.py; by default each side is killed in some trial."""
    parser.addoption("--trials", type=int, default=3, metavar="N")
    parser.addoption("--seed", type=int, default=5)


@pytest.fixture(scope="session", autouse=True)
def master():
    with own_master():
        yield


def starting():
    """Yield start(words), which starts a program that ends by Ctrl-C after the test."""
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
    print(program.output)  # pytest shows it if the test fails


start = pytest.fixture(starting, name="start")
start_for_all = pytest.fixture(starting, scope="module", name="start_for_all")


@pytest.fixture
def start_ros2(start):
    """start_ros2(file, ...): a Python program with ROS 2."""
    return lambda *words: start(*ros2_python.command([str(word) for word in words]))


@pytest.fixture
def bridge(start, tmp_path):
    """bridge({topic: direction}): a Bridge that carries these topics, or those of our list."""

    def begin(topics=None):
        given, file = [], tmp_path / "topics.yaml"
        if topics:
            listed = {topic: {"direction": direction} for topic, direction in topics.items()}
            file.write_text(json.dumps({"topics": listed}))
            given = [f"_topics:={file}"]
        return Bridge(start("rosrun", "ros2_bridge", "bridge", *given))

    return begin


@pytest.fixture
def ear():
    """ear(topic, kind): the growing list of messages on a topic of ROS 1."""
    with ExitStack() as stack:

        def listen(topic, kind):
            heard = []
            subscriber = rospy.Subscriber(topic, kind, heard.append, tcp_nodelay=True)
            stack.callback(subscriber.unregister)
            return heard

        yield listen


@pytest.fixture
def stick():
    with Stick() as made:
        yield made
