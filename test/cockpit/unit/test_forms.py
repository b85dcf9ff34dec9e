"""Messages from what a person writes into a form, and who may publish them."""

import json
import xmlrpc.client
from types import SimpleNamespace

import pytest
import rospy
from roslib.message import get_message_class

from cockpit_server.errors import RefusedError
from cockpit_server.graph import Graph
from cockpit_server.pages import LOOKS_ONLY
from cockpit_server.ros.tabs import forms
from cockpit_server.ros.tabs.outlets import Outlets
from cockpit_server.tabs.publishing import Publishing
from node_kit.errors import ServiceError
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Free, Graphs, page

pytestmark = claim(
    "A page that only looks publishes and calls nothing, nor one beside a driver; a hostile value "
    "is one line"
)


@pytest.fixture
def filled(monkeypatch):
    """A function that fills a form of a type at the time 7."""
    monkeypatch.setattr(forms.rospy.Time, "now", lambda: rospy.Time(7))
    return lambda kind, **texts: forms.filled(get_message_class(kind), texts)


def test_message_has_what_the_form_has_and_zeros(filled):
    joy = filled("sensor_msgs/Joy", **{"header/stamp": "now", "axes": "[1, 0.5]"})
    assert (joy.header.stamp.secs, joy.axes, joy.buttons) == (7, [1, 0.5], [])
    assert filled("std_msgs/Time", data='{"secs": 12}').data == rospy.Time(12)
    moved = filled("tf2_msgs/TFMessage", transforms='[{"transform": {"translation": {"x": 1}}}]')
    assert moved.transforms[0].transform.translation.x == 1


@pytest.mark.parametrize(
    ("kind", "name", "text"),
    [("UInt8", "data", "256"), ("Int32", "data", "0.5"), ("Float64", "data", "now"),
     ("Float64", "data", "9" * 1999), ("Float32", "data", "1e39"), ("Time", "data", "-1"),
     ("Float64MultiArray", "data", "[" * 1999), ("Float64MultiArray", "data", '["a"]'),
     ("String", "data", "\ud800"), ("String", "__class__", "a"), ("Time", "data", "NaN")],
)  # fmt: skip
def test_hostile_value_is_one_line(filled, kind, name, text):
    with pytest.raises(ValueError, match=r"^[^\n]{5,250}$"):
        filled(f"std_msgs/{kind}", **{name: text})


@pytest.mark.parametrize(
    ("written", "value"),
    [("0.5", 0.5), ("[1, 2]", [1, 2]), ('{"a": true}', {"a": True}), ("a b", "a b"), ('"5"', "5")],
)
def test_parameter_is_set_as_rosparam_does_and_shown_as_it_is_then(monkeypatch, written, value):
    master = {}
    monkeypatch.setattr(forms.rospy, "set_param", master.__setitem__)
    monkeypatch.setattr(forms.rospy, "get_param", master.get)
    assert json.loads(forms.set_parameter("/x", written)["definition"]) == master["/x"] == value


@pytest.mark.parametrize("written", ["null", "9" * 20, "[" * 2000, "1e999", "\0", "[NaN"])
def test_hostile_parameter_is_one_line_or_a_value(monkeypatch, written):
    """XML-RPC carries it, or the page gets one line."""
    arrived = []
    marshalled = lambda _name, value: arrived.append(xmlrpc.client.dumps((value,)))  # noqa: E731
    monkeypatch.setattr(forms.rospy, "set_param", marshalled)
    monkeypatch.setattr(forms.rospy, "get_param", lambda *_: 1)
    client, sent = page()
    at_once = lambda target, daemon: SimpleNamespace(start=target)  # noqa: E731
    monkeypatch.setattr(forms.threading, "Thread", at_once)
    source = forms.Forms(Free(), lambda act: act(), Graphs())
    source.on_set(client, 0.0, "/x", {"value": written})
    [said] = sent
    assert said["kind"] == ("form" if arrived else "refused")
    assert "\n" not in said.get("why", "") and len(said.get("why", "")) <= 200


@pytest.mark.parametrize(
    ("role", "driver", "topic", "kind", "why"),
    [
        ("viewer", None, "/x", "std_msgs/String", LOOKS_ONLY),
        ("driver", 3, "/x", "std_msgs/String", "another page drives"),
        ("driver", 7, "/x", "std_msgs/Bool", "/x: no topic of the type std_msgs/Bool"),
        ("driver", None, "/a b", "std_msgs/Bool", "/a b: no topic"),
        ("driver", 7, "/r/joy", "sensor_msgs/Joy", "a joystick is moved in"),
    ],
)
def test_who_may_publish_what(role, driver, topic, kind, why):
    types = {"/x": "std_msgs/String"}
    graph = Graph({"/x": {"/x"}}, services={"/x/reset": {"/x"}}, types=types)
    (client, _), graphs, driving = page(role), Graphs(graph), Free(driver)
    source, publishing = (
        forms.Forms(driving, None, graphs),
        Publishing(driving, graphs, Outlets(graphs)),
    )
    with pytest.raises(RefusedError, match=f"^{why}"):
        publishing.on_publish(client, 0.0, topic=topic, type=kind, values={}, period=None)
    if kind == "std_msgs/String":
        with pytest.raises(RefusedError, match=f"^{why}"):
            source.on_call(client, 0.0, "/x/reset", {})
        with pytest.raises(RefusedError, match=f"^{why}"):
            source.on_set(client, 0.0, "/rate", {"value": "1"})


@claim("By keyboard alone ...", because="a name that once had another type")
def test_a_topic_that_nobody_has_any_more_may_get_another_type(filled):
    """The master keeps the type of each topic that it ever had."""
    graphs = Graphs(Graph(types={"/x": "std_msgs/String"}))
    publishing = Publishing(Free(), graphs, Outlets(graphs))
    message = publishing._message(page()[0], "/x", "std_msgs/Int32", {"data": "7"})
    assert message == filled("std_msgs/Int32", data="7")


def test_types_are_listed_for_drivers_and_described_before_anybody_has_them(monkeypatch):
    at_once = lambda target, daemon: SimpleNamespace(start=target)  # noqa: E731
    monkeypatch.setattr(forms.threading, "Thread", at_once)
    source = forms.Forms(Free(), lambda act: act(), Graphs())
    (driver, said), (viewer, _) = page(), page("viewer")
    source.on_describe(driver, 0.0, "types", "")
    types = said[-1]["types"]
    assert types == sorted(types) and {"std_msgs/Int32", "geometry_msgs/Twist"} <= set(types)
    assert all(forms.message_class(name) for name in types)
    source.on_describe(driver, 0.0, "message", "std_msgs/Int32")
    assert said[-1]["fields"] == [["data", "int32"]]
    for what, name in (("types", ""), ("message", "std_msgs/Int32")):
        with pytest.raises(RefusedError):
            source.on_describe(viewer, 0.0, what, name)


@claim(
    "A service that never answers is refused to the page that called it alone, and given up in time"
)
def test_a_service_that_never_answers_is_refused_to_its_page_alone(monkeypatch):
    """Other pages may call and reset; call_service gives up in time."""
    started = []
    later = lambda target, daemon: SimpleNamespace(start=lambda: started.append(target))  # noqa: E731
    monkeypatch.setattr(forms.threading, "Thread", later)
    monkeypatch.setattr(forms, "MOST_CALLS", 3)
    graph = Graph(services={"/reset": {"/x"}})
    driving = Free()
    driving.must_rest = lambda *_: None
    source = forms.Forms(driving, lambda act: act(), Graphs(graph))
    (anna, sent), (bob, _), (eve, _) = page(number=1), page(number=2), page(number=3)
    source.on_call(anna, 0.0, "/reset", {})
    with pytest.raises(RefusedError, match="called from this page and has not answered"):
        source.on_call(anna, 0.0, "/reset", {})
    source.on_call(bob, 0.0, "/reset", {})
    source.on_reset(eve, 0.0, "")
    with pytest.raises(RefusedError, match="3 calls wait"):
        source.on_describe(eve, 0.0, "parameter", "/x")
    never = ServiceError("/reset has not answered for 30 s")
    monkeypatch.setattr(forms, "kind_of", lambda _: (_ for _ in ()).throw(never))
    started[0]()
    assert sent[-1]["why"] == str(never)
    source.on_call(anna, 0.0, "/reset", {})
