"""The graph as pages get it: robots, their reset services, and what is left out."""

import pytest

from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, ODOMETRY, Graph, without

GRAPH = Graph(
    publishers={"/odom": {"/sim"}, "/robot_1/odom": {"/room"}, "/robot_2/odom": {"/room"}},
    subscribers={"/odom": {"/rviz"}, "/real/joy": {"/joy2twist"}},
    services={"/sim/reset": {"/sim"}, "/room/reset": {"/room"}, "/robot_2/reset": {"/room"}},
    types={
        "/odom": ODOMETRY, "/robot_1/odom": ODOMETRY, "/robot_2/odom": "std_msgs/String",
        "/real/joy": JOY,
    },
)  # fmt: skip


def test_reset_is_of_one_robot():
    assert (GRAPH.reset_service(""), GRAPH.why_no_reset("")) == ("/sim/reset", "")
    assert GRAPH.reset_service("robot_2") == "/robot_2/reset"
    with pytest.raises(RefusedError, match="no node has a service that resets robot_1"):
        GRAPH.reset_service("robot_1")  # the node's own service would reset both


def test_robots_hear_a_joystick_or_have_an_odometry():
    assert GRAPH.robots() == {"", "robot_1", "real"}
    topics = ("/cmd_vel", "/robot_1/cmd_vel_mux/input", "/robot_11/x")
    assert list(map(GRAPH.robot_with, topics)) == ["", "robot_1", ""]
    assert Graph().robot_with("/turtle1/cmd_vel") == "turtle1"
    column = [["/odom", ["/sim", "/cockpit"]], ["/joy", ["/cockpit"]]]
    assert without({"/cockpit"}, column, ["/joy"]) == {"/odom": {"/sim"}, "/joy": {"/cockpit"}}
