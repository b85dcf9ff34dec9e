"""The pictures of turtlesims: requested while a page shows them, each sent once."""

import pytest

from cockpit_server.graph import POSE, Graph
from cockpit_server.ros.tabs import turtles
from node_kit.rules.answer import Answer
from tutorial_testing.session_room import Graphs, look, page

GRAPH = Graph(publishers={"/turtle1/pose": {"/sim"}}, types={"/turtle1/pose": POSE})


@pytest.fixture
def shown(monkeypatch):
    """A function that returns the pictures that the page is sent when the node answers this."""
    source, now = turtles.Turtles(Graphs(GRAPH)), [0.0]
    monkeypatch.setattr(source._thread, "submit", lambda act, *given: act(*given))
    viewer = page(turtles=True)

    def shown(answer, value=None):
        monkeypatch.setattr(turtles, "call", lambda *_, **__: (answer, value))
        now[0] += 1
        return [sent["pictures"] for sent in look(source, viewer, now=now[0])[0]]

    return shown


def test_a_picture_is_sent_once_and_stays_while_its_node_is_busy(shown):
    assert shown(Answer.WELL, [1, "abc"]) == [{"/sim": "abc"}]
    assert shown(Answer.WELL, [1, ""]) == shown(Answer.SILENT) == []
    assert shown(Answer.WELL, [2, "def"]) == [{"/sim": "def"}]
    assert shown(Answer.REFUSED) == [{}]


@pytest.mark.parametrize("given", [None, 7, [1], [True, "a"], [1, "a" * 1_000_001], ["1", "a"]])
def test_what_is_no_picture_is_none(shown, given):
    assert shown(Answer.WELL, given) == [{}]
