"""What pages are sent of robots, of their joysticks and of topics."""

import time
from math import inf, nan
from types import SimpleNamespace

import pytest
from kobuki_msgs.msg import Led, Sound
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from std_msgs.msg import Header, String

from cockpit_server.graph import JOY, ODOMETRY, Graph
from cockpit_server.motion import Motion
from cockpit_server.sources import robots as robots_module
from cockpit_server.sources.graph_view import LONGEST_MESSAGE, Topic
from cockpit_server.sources.robots import LONGEST_JOY, Pads, Robots, joy_shown, shown
from tutorial_testing.seat_room import page, serialised

PARTS = {"led1", "led2", "sound"}  # of a Kobuki


class Feeds:
    def want(self, _owner, hears, every):
        self.hears = hears


class FeedsByOwner:
    def __init__(self):
        self.hears = {}

    def want(self, owner, hears, every):
        self.hears[owner] = hears


def graph(*robots):
    """These robots with an odometry, and robot_9, which only hears a joystick."""
    return Graph(
        publishers={f"/{robot}/odom": {"/sim"} for robot in robots},
        subscribers={"/robot_9/joy": {"/joy2twist"}},
        types={"/robot_9/joy": JOY, **{f"/{robot}/odom": ODOMETRY for robot in robots}},
    )


def test_the_names_of_robots_come_when_they_change_to_pages_that_look_at_them():
    graphs = SimpleNamespace(graph=graph("robot_2", "robot_1"))
    robots, (one, sent), (other, nothing) = Robots(Feeds(), graphs), page(robots=True), page()

    def names():
        sent.clear()
        robots.prepare([one, other], 0.0)
        robots.give(one, 0.0)
        robots.give(other, 0.0)
        return [message["names"] for message in sent if message["kind"] == "names"]

    assert names() == [["robot_1", "robot_2", "robot_9"]]
    assert names() == []
    graphs.graph = graph("robot_1")
    assert names() == [["robot_1", "robot_9"]]
    assert nothing == []


def test_pages_get_what_a_kobuki_was_last_asked_for():
    feeds = FeedsByOwner()
    here, there = "/ada/mobile_base/commands/led1", "/mobile_base/commands/sound"
    sim = graph("ada", "")
    sim.types.update({here: "kobuki_msgs/Led", there: "kobuki_msgs/Sound", "/other/led1": "x/Led"})
    robots, (one, sent) = Robots(feeds, SimpleNamespace(graph=sim)), page(robots=True)

    def seen():
        robots.prepare([one], 0.0)
        for topic, hear in feeds.hears[robots].items():
            hear(SimpleNamespace(data=serialised(Odometry())), topic)
        sent.clear()
        robots.prepare([one], 0.0)
        robots.give(one, 0.0)
        found = next(message["robots"] for message in sent if message["kind"] == "robots")
        return {r: {part: v for part, v in of.items() if part in PARTS} for r, of in found.items()}

    assert seen() == {"ada": {}, "": {}}
    commands = feeds.hears[robots, "kobuki"]
    assert set(commands) == {here, there}
    for topic, message in (
        (here, Led(Led.ORANGE)),
        (there, Sound(Sound.CLEANINGEND)),
        (here, Led(9)),
    ):
        commands[topic](SimpleNamespace(data=serialised(message)), topic)
    assert seen() == {"ada": {"led1": "orange"}, "": {"sound": "cleaningend"}}


@pytest.mark.parametrize(
    ("wrong", "left_out"),
    [
        ({}, set()),
        *[(wrong, {"x", "y", "yaw"}) for wrong in ({"x": nan}, {"y": inf}, {"yaw": nan})],
        *[(wrong, {"x", "y", "yaw"}) for wrong in ({"x": 1e6 + 1}, {"y": -1e300})],
        ({"w": nan}, {"w"}),
    ],
)
def test_an_impossible_place_is_left_out(wrong, left_out):
    state = Motion(1.0, -1e6, 0.5, 0.25, -0.5)._replace(**wrong)
    everything = {"x", "y", "yaw", "v", "w", "covered", "age"}
    assert set(shown(state, 1.0, 2.0, 3.0)) == everything - left_out
    assert [shown(state, 1.0, 2.0, now)["age"] for now in (0.9, 1.9, 2.1)] == [0, 0, 1]


def test_a_page_gets_only_the_robots_that_changed_since_it_was_sent_some():
    feeds, graphs = FeedsByOwner(), SimpleNamespace(graph=graph("ada", "bob"))
    robots = Robots(feeds, graphs)
    (one, sent), (late, sent_late) = page(robots=True), page(robots=True)

    def place(robot, x):
        odometry = Odometry()
        odometry.pose.pose.position.x = x
        data = SimpleNamespace(data=serialised(odometry))
        feeds.hears[robots][f"/{robot}/odom"](data, f"/{robot}/odom")

    def seen(client=one, sent=sent):
        now = time.monotonic()
        robots.prepare([one, late], now)
        robots.give(client, now)
        newest = sent[-1]
        return newest["all"], {name: state["x"] for name, state in newest["robots"].items()}

    assert seen() == (True, {})
    for robot in ("ada", "bob"):
        place(robot, 1.0)
    assert seen() == (True, {"ada": 1.0, "bob": 1.0})
    place("ada", 1.0)
    assert seen() == (False, {})  # it stands; the message still says that the server is there
    place("bob", 2.0)
    robots.prepare([one, late], time.monotonic())  # one is behind
    assert seen() == (False, {"bob": 2.0})
    assert seen(late, sent_late) == (True, {"ada": 1.0, "bob": 2.0})
    graphs.graph = graph("bob")
    assert seen() == (True, {"bob": 2.0})  # so ada is gone
    one.seen.clear()  # it asked for something else
    assert seen() == (True, {"bob": 2.0})


def test_a_joystick_as_pages_get_it():
    joy = Joy(axes=[0.123456, inf], buttons=[1, 0])
    assert joy_shown(serialised(joy)) == {"axes": [0.1235, 0.0], "buttons": [1, 0]}
    assert joy_shown(b"none") is None
    joy = Joy(buttons=[0] * ((LONGEST_JOY - 24) // 4))  # beside header and two lengths
    assert len(serialised(joy)) == LONGEST_JOY == 4000
    assert joy_shown(serialised(joy)) == {"axes": [], "buttons": joy.buttons}
    joy.header = Header(frame_id="x")
    assert joy_shown(serialised(joy)) is None


def test_a_joystick_message_is_read_once_for_all_pages(monkeypatch):
    read = []
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: read.append(data) or {"axes": []})
    monkeypatch.setattr(robots_module, "sender_of", lambda message: "/other")
    feeds = Feeds()
    pads = Pads(feeds, SimpleNamespace(graph=graph("robot_1")), "/cockpit")
    pages = [page(look=robot) for robot in ("robot_1", "robot_1", "no/such/robot")]

    def tick():
        pads.prepare([one for one, _ in pages], 0.0)
        for one, _ in pages:
            pads.give(one, 0.0)

    tick()
    assert set(feeds.hears) == {"/robot_1/joy"}
    for data in (b"1", b"2"):
        feeds.hears["/robot_1/joy"](SimpleNamespace(data=data), "/robot_1/joy")
        tick()
        tick()
    assert read == [b"1", b"2"]
    assert [len(sent) for _, sent in pages] == [2, 2, 0]
    for pages[1][0].watch.look in ("no/such/robot", "robot_1"):  # it looks away, and back
        tick()
    assert [len(sent) for _, sent in pages] == [2, 3, 0]
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: [].pop())
    monkeypatch.setattr(robots_module, "sender_of", lambda message: "/rival")
    with pytest.raises(IndexError):
        feeds.hears["/robot_1/joy"](SimpleNamespace(data=b""), "/robot_1/joy")
    assert pads.rival("robot_1", 0.0) == "/rival"  # whatever is in its message
    assert pads.rival("robot_1", inf) is None


def test_a_long_message_is_shown_by_its_length():
    topic = Topic()
    for length, text in ((LONGEST_MESSAGE - 4, 'data: "xxx'), (LONGEST_MESSAGE, "(20004 bytes)")):
        topic.hear(SimpleNamespace(data=serialised(String("x" * length))), "/x")
        assert topic.text("std_msgs/String").startswith(text)
