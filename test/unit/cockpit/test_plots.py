"""Curves: when what is drawn was."""

from io import BytesIO
from types import SimpleNamespace

import pytest
import rospy
from sensor_msgs.msg import Joy
from std_msgs.msg import Float64

from cockpit_server import plots
from cockpit_server.graph import Graph

NOW = 1000.0


def sample(monkeypatch, kind, message):
    monkeypatch.setattr(plots.rospy, "get_time", lambda: NOW)
    field = "/x/axes[0]" if kind == "sensor_msgs/Joy" else "/x/data"
    graph = Graph(publishers={"/x": {"/n"}}, types={"/x": kind})
    feeds = SimpleNamespace(want=lambda *_, **__: None)
    one = plots.Plots(feeds, SimpleNamespace(graph=graph))
    watch = SimpleNamespace(fields=(field,), field_list=False)
    client = SimpleNamespace(watch=watch, seen={"plot": 0}, send=None)
    one.prepare([client], 0.0)
    data = BytesIO()
    message.serialize(data)
    one._hear(SimpleNamespace(data=data.getvalue()), "/x")
    sent = []
    client.send = lambda _kind, samples: sent.extend(samples[field])
    one.give(client, 0.0)
    (found,) = sent
    return found


@pytest.mark.parametrize(
    ("stamp", "t"),
    [(NOW - 1.0, NOW - 1.0), (NOW + 1.0, NOW + 1.0), (NOW - 1.1, NOW), (NOW + 1.1, NOW), (0, NOW)],
)
def test_a_stamp_of_another_clock_is_none(monkeypatch, stamp, t):
    joy = Joy(axes=[0.5])
    joy.header.stamp = rospy.Time.from_sec(stamp)
    assert sample(monkeypatch, "sensor_msgs/Joy", joy) == [t, 0.5]


def test_what_has_no_stamp_is_of_now(monkeypatch):
    assert sample(monkeypatch, "std_msgs/Float64", Float64(2.5)) == [NOW, 2.5]
