"""Messages from what a person writes into a form, and who may publish them."""

from types import SimpleNamespace

import pytest
import rosmsg
import rospy
from roslib.message import get_message_class

from cockpit_server.clients import LOOKS_ONLY
from cockpit_server.fields import definition
from cockpit_server.graph import Graph
from cockpit_server.seat import RefusedError
from cockpit_server.sources import forms
from tutorial_testing.seat_room import page


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    monkeypatch.setattr(forms.rospy.Time, "now", lambda: rospy.Time(7))


@pytest.mark.parametrize("kind", ["nav_msgs/Odometry", "sensor_msgs/BatteryState"])
def test_definition_is_that_of_rosmsg_show(kind):
    lines = definition(get_message_class(kind), forms.class_of)
    assert "\n".join(lines) == rosmsg.get_msg_text(kind).strip()


def filled(kind, **texts):
    return forms.filled(get_message_class(kind), texts)


def test_message_has_what_the_form_has_and_zeros():
    joy = filled("sensor_msgs/Joy", **{"header/stamp": "now", "axes": "[1, 0.5]"})
    assert (joy.header.stamp.secs, joy.axes, joy.buttons) == (7, [1, 0.5], [])
    assert filled("geometry_msgs/Twist", **{"linear/x": "0.5"}).linear.x == 0.5
    assert filled("std_msgs/Time", data="12.5").data == rospy.Time(12, 500_000_000)
    moved = filled("tf2_msgs/TFMessage", transforms='[{"transform": {"translation": {"x": 1}}}]')
    assert moved.transforms[0].transform.translation.x == 1


@pytest.mark.parametrize(
    ("kind", "name", "text"),
    [("UInt8", "data", "256"), ("Int32", "data", "0.5"), ("Int32", "data", "{}"),
     ("Float64", "data", "now"), ("Float64", "data", "9" * 1999), ("Float32", "data", "1e39"),
     ("Float64MultiArray", "data", "[" * 1999), ("Float64MultiArray", "data", '["a"]'),
     ("String", "data", "\ud800"), ("String", "__class__", "a"), ("String", "data/x", "a"),
     ("Time", "data", "1e300"), ("Time", "data", "NaN"), ("Time", "data", "-1")],
)  # fmt: skip
def test_hostile_value_is_one_line(kind, name, text):
    with pytest.raises(ValueError, match=r"^[^\n]{5,250}$"):
        filled(f"std_msgs/{kind}", **{name: text})


GRAPH = Graph(services={"/x/reset": {"/x"}}, types={"/x": "std_msgs/String"})
GOOD = {"topic": "/x", "type": "std_msgs/String", "values": {}}


@pytest.mark.parametrize(
    ("role", "driver", "given", "why"),
    [
        ("viewer", None, {}, LOOKS_ONLY), ("driver", 3, {}, "another page drives"),
        ("driver", None, {"type": "std_msgs/Bool"}, "/x: no topic of the type std_msgs/Bool"),
        ("driver", None, {"topic": "/a b"}, "/a b: no topic"),
        ("driver", None, {"topic": "/y", "type": "no_such/Type"}, "/y: no topic of the type"),
        ("driver", 7, {"topic": "/r/joy", "type": "sensor_msgs/Joy"}, "a joystick is moved in"),
    ],
)  # fmt: skip
def test_page_that_only_looks_or_beside_a_driver_publishes_and_calls_nothing(
    role, driver, given, why
):
    hub = SimpleNamespace(seat=SimpleNamespace(driver=driver))
    source, (client, _) = forms.Forms(hub, SimpleNamespace(graph=GRAPH)), page(role)
    with pytest.raises(RefusedError, match=f"^{why}"):
        source.on_publish(client, 0.0, **{**GOOD, **given})
    if not given:
        with pytest.raises(RefusedError, match=f"^{why}"):
            source.on_call(client, 0.0, "/x/reset", {})
        with pytest.raises(RefusedError, match=f"^{why}"):
            source.on_describe(client, 0.0, "service", "/x/reset")
