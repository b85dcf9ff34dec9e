"""A page that publishes by forms, without ROS and without a browser: time is a number."""

from types import SimpleNamespace

from cockpit_server.graph import JOY
from cockpit_server.ros.tabs.outlets import Outlet, Outlets
from cockpit_server.tabs.publishing import VELOCITY, Publishing
from tutorial_testing.session_room import ANNA, BOB, Free, Graphs, page

TEXT = "std_msgs/String"
VALUES = {VELOCITY: {"linear/x": "1"}, TEXT: {"data": "a"}, JOY: {"axes": "[1]", "buttons": "[1]"}}
TICK_S, BEAT_S = 0.01, 0.05
ONCE = 0.0  # the period for a message that is published once


def value_of(message):
    if message._type == JOY:
        return tuple(message.axes)
    return message.linear.x if message._type == VELOCITY else message.data


class Desk:
    """Anna's page, which publishes from 100 s on, Bob's page, and a clock that is a number."""

    def __init__(self, kind=VELOCITY, period=0.1):
        self.driving, self.now, self.published = Free(), 100.0, []
        graphs = Graphs()
        kept = Outlets(graphs)
        self.repeats = Publishing(self.driving, graphs, kept)
        publish = lambda message: self.published.append((self.now, value_of(message)))  # noqa: E731
        kept._outlets["/cmd_vel", kind] = Outlet(99.0, 99.0, None, SimpleNamespace(publish=publish))
        self.anna, self.bob = page(number=ANNA), page(number=BOB)
        self.driving._pages.update({ANNA: self.anna[0], BOB: self.bob[0]})
        self.kind, self.period, self.n, self.network_s = kind, period, 0, 0.0
        self.is_silent = False
        self.publish(VALUES[kind])

    def publish(self, values):
        self.step, self.steps = 0, max(1, round(self.period / BEAT_S))
        self.sign_s = self.period / self.steps or BEAT_S
        form = {"topic": "/cmd_vel", "type": self.kind, "values": values}
        self.repeats.on_publish(self.anna[0], self.now, period=self.period or None, **form)

    def pass_time(self, seconds):
        """Let time pass for the server, while Anna's page sends its signs of life."""
        for _ in range(round(seconds / TICK_S)):
            self.now += TICK_S
            self.driving.tick(self.now)
            tick = round(self.now / TICK_S)
            if tick % round(BEAT_S / TICK_S) == 0:
                self.driving.beat(self.now)
                self.repeats.collect(list(self.driving._pages.values()), self.now)
            if tick % round(self.sign_s / TICK_S) == 0 and not self.is_silent:
                self.sign()

    def sign(self):
        self.n, self.step = self.n + 1, self.step + 1
        due = "/cmd_vel" if self.period > 0 and self.step % self.steps == 0 else None
        beat = next((said["n"] for said in self.anna[1][::-1] if said["kind"] == "beat"), 0)
        t = 1000 * (self.now - self.network_s)
        self.repeats.on_again(self.anna[0], self.now, n=self.n, t=t, beat=beat, due=due)

    @property
    def values(self):
        return [value for _, value in self.published]

    def close(self):
        del self.driving._pages[ANNA]
        self.is_silent = True
        self.driving.gone(self.anna[0])

    def fall_silent(self):
        self.is_silent = True

    def delay(self):
        self.network_s = 0.5


class Several(Desk):
    """Anna's page publishes texts on /a and /b, and a motion."""

    def __init__(self):
        super().__init__(VELOCITY, 0.1)
        self.timers = {}
        self.add("/cmd_vel", VELOCITY, 0.1, **VALUES[VELOCITY])
        self.published.clear()
        self.add("/a", TEXT, 0.5, data="a")
        self.add("/b", TEXT, 0.1, data="b")
        self.sign_s = BEAT_S

    def add(self, topic, kind, period, **values):
        publish = lambda message: self.published.append((topic, value_of(message)))  # noqa: E731
        outlet = Outlet(99.0, 99.0, None, SimpleNamespace(publish=publish, end=lambda: None))
        self.repeats._publishers._outlets[topic, kind] = outlet
        form = {"topic": topic, "type": kind, "values": values, "period": period}
        self.repeats.on_publish(self.anna[0], self.now, **form)
        self.timers[topic] = period

    def sign(self):
        """Sign, and once for each topic that is due, as the page's timers do."""
        tick = round(self.now / TICK_S)
        due = [topic for topic, s in self.timers.items() if s and tick % round(s / TICK_S) == 0]
        for topic in [None, *due]:
            self.n += 1
            beat = next((said["n"] for said in self.anna[1][::-1] if said["kind"] == "beat"), 0)
            sign = {"n": self.n, "t": 1000 * (self.now - self.network_s), "beat": beat}
            self.repeats.on_again(self.anna[0], self.now, **sign, due=topic)

    def on(self, topic):
        return [value for name, value in self.published if name == topic]

    @property
    def counts(self):
        """The number of messages on each topic, as the page is sent them."""
        self.anna[0].seen.clear()
        self.anna[1].clear()
        self.repeats.send_to(self.anna[0], self.now)
        lists = [said["topics"] for said in self.anna[1] if said["kind"] == "running"]
        return {its["topic"]: its["count"] for topics in lists for its in topics}
