"""What a page publishes again and again ends when its page is silent, late, gone, or must not."""

from types import SimpleNamespace

import pytest

from cockpit_server.clients import RefusedError
from cockpit_server.graph import Graph
from cockpit_server.sources import forms, publishing
from cockpit_server.sources.publishing import VELOCITY, Outlet, Publishing
from tutorial_testing.session_room import Free, page

PERIOD_S = 0.1
VALUES = {"linear/x": "1"}


class Desk:
    """A page that repeats a velocity since 100 s, and what it has published: speeds."""

    def __init__(self):
        self.driving = Free()
        self.speeds, self.repeats = [], Publishing(self.driving, SimpleNamespace(graph=Graph()))
        publisher = SimpleNamespace(publish=lambda twist: self.speeds.append(twist.linear.x))
        self.repeats._outlets["/cmd_vel", VELOCITY] = Outlet(99.0, 99.0, None, publisher)
        (self.page, _), self.now = page(), 100.0
        self.publish(VALUES)

    def publish(self, values):
        about = {"topic": "/cmd_vel", "type": VELOCITY, "period": PERIOD_S}
        self.repeats.on_publish(self.page, self.now, values=values, **about)

    def again(self, after_s=PERIOD_S, late_s=0.0):
        self.now += after_s
        self.repeats.collect([self.page], self.now)
        self.repeats.on_again(self.page, self.now, 1000 * (self.now - late_s))


@pytest.fixture
def desk(monkeypatch):
    monkeypatch.setattr(forms.rospy.Time, "now", lambda: None)
    made = Desk()
    made.again()
    assert made.speeds == [1.0, 1.0]
    made.speeds.clear()
    return made


@pytest.mark.parametrize("end", ["gone", "silent", "late", "stopped"])
def test_a_loss_publishes_one_zero_and_nothing_before_a_person_begins_again(desk, end):
    if end == "late":  # as what a network delivers after a cut
        desk.again(late_s=0.2)
        desk.again(late_s=0.2)
    if end == "stopped":
        desk.repeats.on_publish_end(desk.page, desk.now)
    for _ in range(5):
        desk.now += 0.1
        desk.repeats.collect([] if end == "gone" else [desk.page], desk.now)
    assert desk.speeds == [0.0]
    with pytest.raises(RefusedError, match="publish again"):
        desk.again()
    assert desk.speeds == [0.0]


def test_another_page_that_drives_ends_it(desk):
    desk.driving.driver = 3
    with pytest.raises(RefusedError, match="another page drives"):
        desk.again()
    assert desk.speeds == [0.0]


def test_a_page_repeats_one_message(desk):
    desk.publish({})
    assert desk.speeds == [0.0, 0.0]  # the end of the first one, and the second one


def test_the_first_message_waits_for_the_subscribers(monkeypatch):
    sent = []
    publisher = SimpleNamespace(publish=sent.append, names={"/a"})
    monkeypatch.setattr(publishing, "PromptPublisher", lambda *_: publisher)
    for wanted, counts in (({"/a"}, [1, 1, 1]), ({"/b"}, [1, 1, 2])):
        outlet = Outlet(0.0, 0.0, "message")
        outlet.open("/x", None)
        assert [outlet.send_first(wanted, now) or len(sent) for now in (0.0, 0.5, 1.1)] == counts
