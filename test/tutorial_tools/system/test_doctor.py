"""The doctor beside real nodes without a joystick, whose master is restarted."""

import contextlib

import pytest

from node_kit.ros.graph.ros_api import known_nodes
from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ROBOT = ("/fake_turtlebot", "/robot_state_publisher")  # in Python, and in C++


@pytest.fixture
def start():
    """start(command ...): start a program that ends with the test."""
    with contextlib.ExitStack() as stack:
        yield lambda *command: stack.enter_context(Program(*command))


@pytest.fixture
def roscore(start, master_uri):
    """roscore(): start a master; return it when it answers."""

    def run():
        program = start("roscore", "-p", master_uri.rsplit(":", 1)[1])
        wait_for(lambda: "/rosout" in known_nodes(master_uri), "master")
        return program

    return run


def doctor(start):
    """Return the lines that are wrong."""
    program = start(node_path("tutorial_tools", "doctor.py"))
    program.wait()
    assert "Traceback" not in program.output
    return [line for line in program.output.splitlines() if line.startswith("wrong")]


@claim(
    "Beside real nodes it names types that differ, and nodes that a restarted master does not know"
)
def test_a_string_for_velocities_and_nodes_of_a_master_that_was_restarted(
    start, roscore, master_uri
):
    core = roscore()
    start("roslaunch", "fake_turtlebot_sim", "fake_turtlebot.launch")
    sender = start("rostopic", "pub", "-r", "5", "/cmd_vel", "std_msgs/String", "forward")
    wait_for(lambda: len(known_nodes(master_uri)) == 4, "robot and sender")
    (line,) = doctor(start)
    assert "/cmd_vel: std_msgs/String comes from /rostopic_" in line
    assert "geometry_msgs/Twist is wanted by /fake_turtlebot" in line
    assert "Inbound TCP/IP connection failed" not in sender.output  # from a request of the doctor
    core.kill()
    wait_for(lambda: not known_nodes(master_uri), "end of the master")
    assert "of a master that has exited" in "".join(doctor(start))
    roscore()
    (line,) = doctor(start)
    assert "unknown to the master, which was restarted meanwhile" in line
    assert all(f"{name} (process " in line for name in ROBOT)
