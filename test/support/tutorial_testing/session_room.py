"""A driver's session, pages and what they show, without ROS: time is a number, nothing waits."""

import json
from types import SimpleNamespace

from cockpit_server.driving.driver_session import DriverSession, PageInput
from cockpit_server.driving.who_drives import Driving
from cockpit_server.graph import Graph
from cockpit_server.messages import ReceivedMessage
from cockpit_server.pages import Page
from tutorial_testing.nodes import serialised

ANNA, BOB = 1, 2
LB = 4
REST = ((0.0,) * 6, (0,) * 12)
DRIVE = ((0.0, 1.0, 0.0, 0.0, 0.0, 0.0), (0,) * LB + (1,) + (0,) * 7)
PERIOD_S = 0.05


class Room:
    """A session, the pages around it, and a clock that is a number."""

    def __init__(self):
        self.sent, self.lost = [], []
        self.session = DriverSession(
            lambda robot, axes, buttons: self.sent.append((robot, axes, buttons)),
            lambda client, why: self.lost.append((client, why)),
        )
        self.now, self.n, self.beats = 100.0, 0, 0

    def pass_time(self, seconds):
        """Let time pass without input, while the server goes on sending beats."""
        end = self.now + seconds
        while self.now < end - 1e-9:
            self.now = min(end, self.now + PERIOD_S / 5)
            self.beat()
            self.session.tick(self.now)

    def beat(self):
        self.beats += 1
        self.session.beat(self.beats, self.now)

    def say(self, position, client=ANNA, n=None):
        """Send an input, a PERIOD_S after the last one."""
        self.now += PERIOD_S
        self.beat()
        self.n += 1
        t = 1000 * (self.now - 50.0)  # the page's clock began 50 s later
        number = self.n if n is None else n
        self.session.input(client, PageInput(number, t, self.beats, *position), self.now)
        self.session.tick(self.now)

    def drive(self):
        """Take the session, release all, then hold LB and the stick."""
        self.session.take(ANNA, "ada", self.now)
        self.beat()
        self.say(REST)
        self.say(DRIVE)
        assert self.sent[-1] == ("ada", *DRIVE)
        self.sent.clear()


class Free(Driving):
    """A Driving without a robot. driver: the number of the page that drives, or None."""

    def __init__(self, driver=None):
        nothing = lambda *_: ""  # noqa: E731
        joysticks = SimpleNamespace(send=nothing, advertise=nothing, rival=nothing)
        super().__init__({}, Graphs(), joysticks, None, None)
        if driver is not None:
            self.session.take(driver, "", 0.0)


def page(role="driver", number=7, **watch):
    """Return (a Page that watches this, what it is sent as dicts)."""
    sent = []
    no = lambda: False  # noqa: E731
    close = lambda: sent.append("closed")  # noqa: E731
    write = lambda text: sent.append(json.loads(text))  # noqa: E731
    client = Page(number, role, "10.0.0.1", write, is_behind=no, is_cut=no, close=close)
    watched = {"robots": False, "floor": False, "look": None, "bag": False, "bag_fields": ()}
    watched.update(watch)
    client.watch = SimpleNamespace(**watched)
    return client, sent


def look(source, *pages, now=0.0):
    """Return what a source sends to each of these pages at a time [s]."""
    for _, sent in pages:
        sent.clear()
    source.collect([client for client, _ in pages], now)
    for client, _ in pages:
        source.send_to(client, now)
    return [list(sent) for _, sent in pages]


class Graphs:
    """Replaces GraphWatch: the graph is the test's."""

    def __init__(self, graph=None):
        self.graph, self.looked_at, self.looks = graph or Graph(), 0.0, 0

    def look_soon(self):
        self.looks += 1


class Topics:
    """Replaces Feeds: the topics that are subscribed to; hear() brings their messages."""

    def __init__(self):
        self.handlers, self.every = {}, set()  # by topic; of which every message is needed

    def set_subscriptions(self, owner, handlers, every):
        self.handlers.update(handlers)
        self.every.update(handlers if every else ())

    def hear(self, topic, message, now=0.1):
        """Deliver a message of ROS, or bytes, from the node /other at a time [s]."""
        data = message if isinstance(message, bytes) else serialised(message)
        self.handlers[topic](ReceivedMessage(topic, data, "/other", now))
