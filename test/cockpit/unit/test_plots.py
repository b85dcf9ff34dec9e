"""Curves: numbers in messages, their names and times."""

from math import inf, nan

import pytest
import rospy
from sensor_msgs.msg import Joy
from std_msgs.msg import Float64, Header

from cockpit_server.graph import Graph
from cockpit_server.ros.tabs import plots
from tutorial_testing.session_room import Graphs, Topics, look, page

NOW = 1000.0


def joy(stamp):
    return Joy(Header(stamp=rospy.Time.from_sec(stamp)), [2.5], [])


@pytest.fixture
def source_of(monkeypatch):
    """A function that returns (Topics, Plots) of a topic /x with messages of a type."""
    monkeypatch.setattr(plots.rospy, "get_time", lambda: NOW)

    def make(kind):
        topics = Topics()
        graph = Graph(publishers={"/x": {"/n"}}, types={"/x": kind})
        return topics, plots.Plots(topics, Graphs(graph))

    return make


@pytest.mark.parametrize(
    ("message", "field", "t"),
    [(joy(NOW - 1.0), "axes[0]", NOW - 1.0), (joy(NOW + 1.1), "axes[0]", NOW),
     (joy(0), "axes[0]", NOW), (Float64(2.5), "data", NOW)],
)  # fmt: skip
def test_sample_has_its_stamp_or_now_where_that_is_missing_or_of_another_clock(
    source_of, message, field, t
):
    viewer = page(fields=(f"/x/{field}",), field_list=True)
    topics, source = source_of(message._type)
    [[fields]] = look(source, viewer)
    assert f"/x/{field.partition('[')[0]}" in fields["fields"]
    assert topics.every == {"/x"}
    topics.hear("/x", message)
    topics.hear("/x", b"short")
    assert look(source, viewer) == [[{"kind": "plot", "samples": {f"/x/{field}": [[t, 2.5]]}}]]
    assert look(source, viewer) == [[]]


def test_of_a_whole_array_pages_get_the_newest_with_a_gap_for_what_is_no_number(source_of):
    viewer = page(fields=("/x/axes",), field_list=False)
    topics, source = source_of("sensor_msgs/Joy")
    look(source, viewer)
    for axes in ([1.0], [inf, 0.5], [nan] * 3000):
        topics.hear("/x", Joy(axes=axes))
    [[sent]] = look(source, viewer)
    assert sent["samples"] == {"/x/axes": [[NOW, [None] * 2000]]}
    topics.hear("/x", Joy(axes=[0.0] * 250_000))  # longer than the longest that is read
    assert look(source, viewer) == [[]]
