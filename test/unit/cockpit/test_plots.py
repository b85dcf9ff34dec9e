"""Curves: when what is drawn was."""

from types import SimpleNamespace

import pytest
import rospy
from sensor_msgs.msg import Joy
from std_msgs.msg import Float64, Header

from cockpit_server.graph import Graph
from cockpit_server.sources import plots
from tutorial_testing.seat_room import page, serialised

NOW = 1000.0


def joy(stamp):
    return Joy(Header(stamp=rospy.Time.from_sec(stamp)), [2.5], [])


@pytest.mark.parametrize(
    ("message", "field", "t"),
    [
        (joy(NOW - 1.0), "axes[0]", NOW - 1.0),
        (joy(NOW + 1.0), "axes[0]", NOW + 1.0),
        (joy(NOW - 1.1), "axes[0]", NOW),
        (joy(NOW + 1.1), "axes[0]", NOW),
        (joy(0), "axes[0]", NOW),
        (Float64(2.5), "data", NOW),
    ],
)
def test_a_stamp_that_is_missing_or_of_another_clock_is_now(monkeypatch, message, field, t):
    monkeypatch.setattr(plots.rospy, "get_time", lambda: NOW)
    graph = Graph(publishers={"/x": {"/n"}}, types={"/x": message._type})
    feeds = SimpleNamespace(want=lambda *_, **__: None)
    source = plots.Plots(feeds, SimpleNamespace(graph=graph))
    client, sent = page(fields=(f"/x/{field}",), field_list=True)
    client.seen["plot"] = 0
    source.prepare([client], 0.0)
    for data in (serialised(message), b"short"):
        source._hear(SimpleNamespace(data=data), "/x")
    source.give(client, 0.0)
    assert f"/x/{field}" in sent[0]["fields"]
    assert sent[1]["samples"] == {f"/x/{field}": [[t, 2.5]]}
    source.give(client, 0.0)
    assert len(sent) == 2
