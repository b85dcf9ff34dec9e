"""Programs of ./tutorial are reachable from this machine only, until the user names an address.

A limit of ROS remains: C++ nodes (rosout, robot_state_publisher, rosbag) answer XML-RPC on every
address, so another machine can end them, or give them a publisher. The master, the Python nodes and
all topics are out of reach.
"""

import re
import socket
import sys

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.two_hosts.scene import REPOSITORY, ROBOT, WORKSTATION
from tutorial_testing.waiting import wait_for

pytestmark = claim("All stays on this machine until the user names an address")
CPP_NODES = {"/rosout", "/robot_state_publisher", "/rosbag"}
MASTER_PORT = 11311
# Prints the ports of an address that accept a connection.
CONNECT = """
import socket, sys
for port in sys.argv[2:]:
    if not socket.socket().connect_ex((sys.argv[1], int(port))): print(port)
"""
# Prints every node and its XML-RPC port.
XML_RPC_PORTS = """
import rosgraph, rosnode
master = rosgraph.Master("/test")
for name in rosnode.get_node_names():
    print(name, master.lookupNode(name).rstrip("/").rsplit(":", 1)[1])
"""


@pytest.fixture(autouse=True)
def nothing_set(monkeypatch):
    for name in ("ROS_IP", "ROS_HOSTNAME", "ROS_MASTER_URI"):
        monkeypatch.delenv(name, raising=False)


def said(host, *command):
    with host.start(*command) as program:
        assert program.wait() == 0, program.output
        return program.output.splitlines()


def listening(host):
    tables = "\n".join(said(host, "cat", "/proc/net/tcp", "/proc/net/tcp6"))
    return {int(port, 16) for port in re.findall(r"^ *\d+: \w+:(\w+) \w+:0000 0A ", tables, re.M)}


def reachable(scene):
    """Return the robot's ports to which the workstation can connect."""
    given = (scene.address(ROBOT), *map(str, listening(scene.network[ROBOT])))
    return set(map(int, said(scene.network[WORKSTATION], sys.executable, "-c", CONNECT, *given)))


def test_no_other_machine_reaches_a_demo(scene):
    host = scene.network[ROBOT]
    with host.start(str(REPOSITORY / "tutorial"), "demo", DISPLAY="") as demo:
        wait_for(lambda: "first /odom" in demo.output or demo.ended, "demo that drives")
        assert not demo.ended, demo.output
        lines = said(host, "/usr/bin/python3", "-c", XML_RPC_PORTS)
        ports = {name: int(port) for name, port in map(str.split, lines)}
        assert set(ports) > CPP_NODES
        known = {MASTER_PORT, *ports.values()}
        assert known < listening(host)  # and topics
        assert reachable(scene) == {ports[name] for name in CPP_NODES}


@pytest.mark.parametrize(
    ("variables", "expected"),
    [
        ({}, "127.0.0.1"),
        ({"ROS_MASTER_URI": "http://127.0.0.1:11399"}, "127.0.0.1"),
        ({"ROS_MASTER_URI": "http://192.0.2.1:11311"}, ""),
        ({"ROS_MASTER_URI": f"http://{socket.gethostname()}:11311"}, ""),
        ({"ROS_IP": "192.0.2.2"}, "192.0.2.2"),
        ({"ROS_HOSTNAME": "robot"}, ""),
    ],
)
def test_loopback_unless_the_user_names_an_address(call, variables, expected):
    assert call("run", "sh", "-c", 'echo "$ROS_IP"', **variables) == (0, f"{expected}\n")
