"""Types that pages and other nodes name: none is imported, and the driver goes on."""

import string
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cockpit_server.errors import RefusedError
from cockpit_server.graph import Graph
from cockpit_server.ros.tabs import forms, plots
from cockpit_server.ros.tabs.outlets import Outlets
from cockpit_server.tabs import topics
from cockpit_server.tabs.publishing import Publishing
from tutorial_testing.session_room import Free, Graphs, Room, Topics, look, page

MODULES = st.sampled_from(["cockpit", "unittest.__main__", "antigravity", "this", "idlelib.idle"])
words = st.text(string.ascii_letters + "_./\0é", max_size=8)
TYPES = st.one_of(words, st.builds("{}/{}".format, MODULES | words, words))


ROOM = Room()
ROOM.drive()


@settings(max_examples=300)
@given(st.lists(TYPES, min_size=10, max_size=10))
def test_hostile_types_of_a_page_or_of_the_graph_are_refused_and_import_nothing(names):
    before = set(sys.modules)
    for name in names:
        judge(name)
    assert set(sys.modules) == before
    assert ROOM.session.armed and not ROOM.sent


def judge(name):
    graphs = Graphs(Graph(publishers={"/t": {"/x"}}, types={"/t": name}))
    client, _ = viewer = page(fields=("/t/x",), field_list=True, topic="/t", rates=("/t",))
    form = {"topic": "/t", "type": name, "values": {}, "period": None}
    with pytest.raises(RefusedError, match="no topic of the type"):
        Publishing(Free(), graphs, Outlets(graphs)).on_publish(client, 0.0, **form)
    with pytest.raises(RefusedError, match="not installed"):
        forms.Forms(Free(), None, graphs).on_describe(client, 0.0, "message", name)
    for kind in (plots.Plots, topics.Topics):
        feeds = Topics()
        source = kind(feeds, graphs)
        look(source, viewer)
        feeds.hear("/t", b"")
        look(source, viewer, now=1.0)
