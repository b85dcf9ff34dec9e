"""What pages are sent of robots and of their joysticks."""

from math import inf
from types import SimpleNamespace

from sensor_msgs.msg import Joy
from std_msgs.msg import String

from cockpit_server import robots as robots_module
from cockpit_server.graph import JOY, ODOMETRY, Graph
from cockpit_server.graph_view import LONGEST_MESSAGE, Topic
from cockpit_server.robots import LONGEST_JOY, Pads, Robots, joy_shown
from tutorial_testing.seat_room import page, serialised


class Feeds:
    def want(self, _owner, hears, every):
        self.hears = hears


def graph(*robots):
    """These robots with an odometry, and robot_9, which only hears a joystick."""
    return Graph(
        publishers={f"/{robot}/odom": {"/sim"} for robot in robots},
        subscribers={"/robot_9/joy": {"/joy2twist"}},
        types={"/robot_9/joy": JOY, **{f"/{robot}/odom": ODOMETRY for robot in robots}},
    )


def test_the_names_of_robots_come_when_they_change():
    graphs = SimpleNamespace(graph=graph("robot_2", "robot_1"))
    robots, (one, sent) = Robots(Feeds(), graphs), page(robots=True)

    def names():
        sent.clear()
        robots.prepare([one], 0.0)
        robots.give(one, 0.0)
        return [message["names"] for message in sent if message["kind"] == "names"]

    assert names() == [["robot_1", "robot_2", "robot_9"]]
    assert names() == []
    graphs.graph = graph("robot_1")
    assert names() == [["robot_1", "robot_9"]]


def test_who_does_not_look_at_robots_is_sent_none():
    one, sent = page()
    robots = Robots(Feeds(), SimpleNamespace(graph=graph("robot_1")))
    robots.prepare([one], 0.0)
    robots.give(one, 0.0)
    assert sent == []


def test_a_joystick_as_pages_get_it():
    joy = Joy(axes=[0.123456, inf], buttons=[1, 0])
    assert joy_shown(serialised(joy)) == {"axes": [0.1235, 0.0], "buttons": [1, 0]}
    assert joy_shown(b"none") is None
    joy = Joy(buttons=[0] * ((LONGEST_JOY - 24) // 4))  # beside header and two lengths
    assert len(serialised(joy)) == LONGEST_JOY == 4000
    assert joy_shown(serialised(joy)) == {"axes": [], "buttons": joy.buttons}
    joy.header.frame_id = "x"
    assert joy_shown(serialised(joy)) is None


def test_a_joystick_message_is_read_once_for_all_pages(monkeypatch):
    read = []
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: read.append(data) or {"axes": []})
    monkeypatch.setattr(robots_module, "sender_of", lambda message: "/other")
    feeds = Feeds()
    pads = Pads(feeds, SimpleNamespace(graph=graph("robot_1")), "/cockpit")
    pages = [page(look="robot_1") for _ in range(3)]

    def tick():
        clients = [one for one, _ in pages]
        pads.prepare(clients, 0.0)
        for one in clients:
            pads.give(one, 0.0)

    tick()
    for data in (b"1", b"2"):
        feeds.hears["/robot_1/joy"](SimpleNamespace(data=data), "/robot_1/joy")
        tick()
        tick()
    assert read == [b"1", b"2"]
    assert [len(sent) for _, sent in pages] == [2, 2, 2]
    pages.append(page(look="no/such/robot"))
    tick()
    assert set(feeds.hears) == {"/robot_1/joy"}


def test_the_text_of_a_long_message_is_not_made():
    topic = Topic()
    for length, text in ((LONGEST_MESSAGE - 4, 'data: "xxx'), (LONGEST_MESSAGE, "(20004 bytes)")):
        topic.hear(SimpleNamespace(data=serialised(String("x" * length))), "/x")
        assert topic.text("std_msgs/String").startswith(text)
