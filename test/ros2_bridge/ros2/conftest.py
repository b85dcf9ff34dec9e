"""A master, the bridge, and programs with ROS 2; this process is a node of ROS 1."""

import json
from contextlib import ExitStack

import pytest
import rospy
from drive import Bridge, Stick, own_master

from node_kit import ros2_python
from tutorial_testing.processes import Program


def pytest_addoption(parser):
    """Of test_faults.py: how many trials, and the seed of the first: here each side is killed."""
    parser.addoption("--trials", type=int, default=3, metavar="N")
    parser.addoption("--seed", type=int, default=5)


@pytest.fixture(scope="session", autouse=True)
def master():
    with own_master():
        yield


def starting():
    """Yield start(words): a program that ends, as by Ctrl-C, with what asked for it."""
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
    """bridge({topic: direction}): a Bridge that carries these, or those of our own list."""

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
    """ear(topic, kind): the list of what comes on a topic of ROS 1, which grows."""
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
