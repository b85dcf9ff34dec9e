"""What pages are sent of robots and of their joysticks."""

import json
from types import SimpleNamespace

from cockpit_server.access import DRIVER
from cockpit_server.clients import Client, Watch
from cockpit_server.graph import JOY, ODOMETRY, Graph
from cockpit_server.robots import Robots


class Feeds:
    """Keeps what is wanted, in the place of subscriptions."""

    def want(self, _owner, hears, every):
        self.hears = hears


def page(**watch):
    """(Client that watches, what it is sent)."""
    sent = []
    no, close = lambda: False, lambda: None
    one = Client(7, DRIVER, "x", lambda text: sent.append(json.loads(text)), no, no, close)
    one.watch = Watch(**watch)
    return one, sent


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
