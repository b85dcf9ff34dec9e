"""Curves: when what is drawn was."""

from types import SimpleNamespace

import pytest
import rospy
from sensor_msgs.msg import Joy
from std_msgs.msg import Float64, Header

from cockpit_server.graph import Graph
from cockpit_server.sources import plots
from tutorial_testing.seat_room import Topics, look, page

NOW = 1000.0


def joy(stamp):
    return Joy(Header(stamp=rospy.Time.from_sec(stamp)), [2.5], [])


@pytest.mark.parametrize(
    ("message", "field", "t"),
    [
        (joy(NOW - 1.0), "axes[0]", NOW - 1.0),
        (joy(NOW + 1.1), "axes[0]", NOW),
        (joy(0), "axes[0]", NOW),
        (Float64(2.5), "data", NOW),
    ],
)
def test_sample_has_its_stamp_or_now_where_that_is_missing_or_of_another_clock(
    monkeypatch, message, field, t
):
    monkeypatch.setattr(plots.rospy, "get_time", lambda: NOW)
    graph = Graph(publishers={"/x": {"/n"}}, types={"/x": message._type})
    topics, one = Topics(), page(fields=(f"/x/{field}",), field_list=True)
    source = plots.Plots(topics, SimpleNamespace(graph=graph))
    [[fields]] = look(source, one)
    assert f"/x/{field}" in fields["fields"]
    topics.hear("/x", message)
    topics.hear("/x", b"short")
    assert look(source, one) == [[{"kind": "plot", "samples": {f"/x/{field}": [[t, 2.5]]}}]]
    assert look(source, one) == [[]]
