"""The first message on a new publisher, and the subscribers that it waits for: time is a number."""

from functools import partial
from types import SimpleNamespace

import pytest

from cockpit_server.graph import Graph
from cockpit_server.ros.tabs import outlets
from cockpit_server.ros.tabs.outlets import Outlets
from cockpit_server.tabs.publishing import VELOCITY
from tutorial_testing.claims import claim
from tutorial_testing.form_desk import TEXT
from tutorial_testing.session_room import Graphs

pytestmark = claim(
    "The first message of a page reaches a node that waits for its topic; a motion waits only for "
    "the subscribers that are known"
)

TEXT_CLASS, TWIST = outlets.message_class(TEXT), outlets.message_class(VELOCITY)


@pytest.fixture
def line(monkeypatch):
    """A new publisher whose subscribers a test connects, in a graph that the test looks at."""
    line = SimpleNamespace(graphs=Graphs(), sent=[], names=set(), registered=[])
    publisher = SimpleNamespace(publish=line.sent.append, names=line.names)
    monkeypatch.setattr(outlets, "PromptPublisher", lambda *_: publisher)
    monkeypatch.setattr(
        outlets, "later", lambda act, *arguments: line.registered.append((act, arguments))
    )
    line.outlets = Outlets(line.graphs)
    return line


def sent_at(line, message, events, until=6.0):
    """Return when [s] a message is sent. events: what happens at a time [s]."""
    line.outlets.send("/x", message, 0.0)
    for tick in range(round(until / 0.05)):
        now = tick * 0.05
        for at in [at for at in events if at <= now]:
            events.pop(at)()
        line.outlets.collect(line.graphs.graph.subscribers, now)
        if line.sent:
            return now
    return None


def happens(line, *, registered=0.2, subscribed=None, looked=(), connected=None, others=()):
    """Return events of a new publisher; the graph has what subscribed before a look."""

    def register():
        for act, arguments in line.registered:
            act(*arguments)

    def look(at):
        line.graphs.looked_at = at
        nodes = [*others, *(["/echo"] if subscribed is not None and subscribed <= at else [])]
        line.graphs.graph = Graph(subscribers={"/x": frozenset(nodes)})

    line.names.update(others)  # connected at once
    events = {at: partial(look, at) for at in looked}
    events[registered + 0.001] = register
    if connected is not None:
        events[connected + 0.002] = lambda: line.names.add("/echo")
    return events


@pytest.mark.parametrize(
    ("course", "text_s", "motion_s"),
    [
        # as rostopic echo: it subscribes once there is a publisher, which an older look lacks
        ({"subscribed": 0.5, "looked": (0.1, 1.2), "connected": 0.6}, 1.2, 0.25),
        ({"subscribed": 0.5, "looked": (0.1, 0.9), "connected": 1.3}, 1.35, 0.25),
        # a subscriber that the graph had before
        ({"subscribed": 0.0, "looked": (0.0, 0.3), "connected": 0.4}, 0.45, 0.45),
        # beside a subscriber that was there before
        (
            {"subscribed": 0.3, "looked": (0.1, 0.9), "connected": 0.4,
             "others": ("/nav",)}, 0.9, 0.25,
        ),
        # it never connects; nobody subscribes
        ({"subscribed": 0.0, "looked": (0.0, 0.3)}, 1.8, 1.05),
        ({"looked": (0.1, 1.2)}, 1.8, 0.25),
        # the master answers late
        ({"registered": 3.0, "subscribed": 3.1, "looked": (0.1, 3.5), "connected": 3.4}, 3.5, 3.05),
    ],
)  # fmt: skip
@pytest.mark.parametrize("kind", [TEXT_CLASS, TWIST])
def test_the_first_message_waits_for_its_subscribers_and_a_motion_for_those_in_the_graph(
    line, kind, course, text_s, motion_s
):
    assert sent_at(line, kind(), happens(line, **course)) == pytest.approx(
        text_s if kind is TEXT_CLASS else motion_s, abs=0.06
    )
    assert line.graphs.looks == 1, "the graph is looked at once there is the publisher"
