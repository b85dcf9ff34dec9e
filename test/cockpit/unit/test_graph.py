"""The graph as pages get it, what the master is asked for it, and its bad answers."""

import threading

import pytest

from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, ODOMETRY, Graph, without
from cockpit_server.ros import graph_watch
from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim

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
        GRAPH.reset_service("robot_1")  # the node's own would reset both


def test_robots_hear_a_joystick_or_have_an_odometry():
    assert GRAPH.robots() == {"", "robot_1", "real"}
    topics = ("/cmd_vel", "/robot_1/cmd_vel_mux/input", "/robot_11/x")
    assert list(map(GRAPH.robot_with, topics)) == ["", "robot_1", ""]
    assert Graph().robot_with("/turtle1/cmd_vel") == "turtle1"
    column = [["/odom", ["/sim", "/cockpit"]], ["/joy", ["/cockpit"]]]
    assert without({"/cockpit"}, column, ["/joy"]) == {"/odom": {"/sim"}, "/joy": {"/cockpit"}}


PUBLISHERS = [["/odom", ["/sim"]], ["/x", ["/cockpit"]], ["/rosout", ["/cockpit"]]]
WELL = {
    "getSystemState": (Answer.WELL, [PUBLISHERS, [], []]), "getPid": (Answer.WELL, 7),
    "getTopicTypes": (Answer.WELL, [["/odom", ODOMETRY]]), "getParamNames": (Answer.WELL, ["/a"]),
    "lookupNode": (Answer.WELL, "http://here:1/"),
}  # fmt: skip
GONE = [
    *[(question, (Answer.REFUSED, None)) for question in ("getSystemState", "getPid")],
    *[(question, (Answer.STRANGE, None)) for question in ("getSystemState", "getPid")],
    ("getPid", (Answer.WELL, 8)),  # another master
]


@pytest.fixture
def master(monkeypatch):
    """Answers by the name of the question, or with its address; a test may change them."""
    answers = dict(WELL)
    answer = lambda uri, name, *_, **__: answers.get((uri, name)) or answers[name]  # noqa: E731
    monkeypatch.setattr(graph_watch, "call", answer)
    monkeypatch.setattr(graph_watch, "PERIOD_S", 0.0)
    monkeypatch.setattr(graph_watch, "MASTER_S", 0.0)
    return answers


@claim("A master that is silent is asked again, and one that has gone is noticed")
@pytest.mark.parametrize(("question", "answer"), GONE)
def test_master_that_has_gone_is_noticed(master, question, answer):
    watch = graph_watch.GraphWatch("/cockpit")
    assert watch.graph.published == ["/odom", "/x"]  # by another node, and from a form
    is_lost = threading.Event()
    watch.start(is_lost.set)
    master[question] = (Answer.SILENT, None)
    assert not is_lost.wait(0.05)
    master[question] = answer
    assert is_lost.wait(30)


def test_a_node_that_was_killed_is_not_shown_until_it_is_back(master):
    """The master still lists it, and waiting for it would keep a page from driving for 2 s."""
    master["http://here:1/", "getPid"] = (Answer.REFUSED, None)
    watch = graph_watch.GraphWatch("/cockpit")
    assert watch.graph.published == ["/x"]
    master["http://here:1/", "getPid"] = (Answer.SILENT, None)  # it is there, and busy
    watch.look()
    assert watch.graph.published == ["/odom", "/x"]
    master["http://here:1/", "getPid"] = (Answer.REFUSED, None)  # each is asked once
    watch.look()
    assert watch.graph.published == ["/odom", "/x"]
