"""What the graph is read from, and bad answers of the master."""

import threading

import pytest

from cockpit_server.graph import ODOMETRY
from cockpit_server.ros import graph_watch
from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

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
    """The answers by method, or by (URI, method); a test may change them."""
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
    master["http://here:1/", "getPid"] = (Answer.SILENT, None)  # it runs, and is busy
    watch.look()
    assert watch.graph.published == ["/odom", "/x"]
    master["http://here:1/", "getPid"] = (Answer.REFUSED, None)  # a node is asked once
    watch.look()
    assert watch.graph.published == ["/odom", "/x"]


@claim("The first message of a page ...", because="the graph is read at once, not in a second")
def test_the_graph_is_looked_at_when_that_is_asked_for(master, monkeypatch):
    monkeypatch.setattr(graph_watch, "PERIOD_S", 1e6)
    watch = graph_watch.GraphWatch("/cockpit")
    is_lost, began = threading.Event(), watch.looked_at
    watch.start(is_lost.set)
    watch.look_soon()
    wait_for(lambda: watch.looked_at > began, "look")
    master["getPid"] = (Answer.REFUSED, None)
    assert is_lost.wait(30)
