"""Questions to the master, and bad answers."""

import threading

import pytest

from cockpit_server import graph_watch
from cockpit_server.graph import ODOMETRY
from node_kit.questions import Answer

WELL = {
    "getSystemState": (Answer.WELL, [[["/odom", ["/sim"]]], [], []]), "getPid": (Answer.WELL, 7),
    "getTopicTypes": (Answer.WELL, [["/odom", ODOMETRY]]),
    "lookupNode": (Answer.WELL, "http://here:1/"),
}  # fmt: skip
GONE = [
    *[(question, (Answer.REFUSED, None)) for question in ("getSystemState", "getPid")],
    *[(question, (Answer.STRANGE, None)) for question in ("getSystemState", "getPid")],
    ("getPid", (Answer.WELL, 8)),  # another master
]


@pytest.fixture
def master(monkeypatch):
    """Answers by the name of the question; a test may change them."""
    answers = dict(WELL)
    monkeypatch.setattr(graph_watch, "call", lambda _uri, name, *_, **__: answers[name])
    monkeypatch.setattr(graph_watch, "PERIOD_S", 0.0)
    return answers


@pytest.mark.parametrize(("question", "answer"), GONE)
def test_master_that_has_gone_is_noticed(master, question, answer):
    watch = graph_watch.GraphWatch("/cockpit")
    is_lost = threading.Event()
    watch.start(is_lost.set)
    master[question] = (Answer.SILENT, None)
    assert not is_lost.wait(0.05)
    master[question] = answer
    assert is_lost.wait(30)
