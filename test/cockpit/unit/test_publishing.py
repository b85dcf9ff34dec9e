"""Forms that publish: when they end, and that one that moves a robot makes its page the driver."""

from types import SimpleNamespace

import pytest
import rospy

from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY
from cockpit_server.ros.tabs import outlets
from cockpit_server.ros.tabs.outlets import Outlet, Outlets
from cockpit_server.tabs import publishing
from cockpit_server.tabs.publishing import VELOCITY, Publishing
from tutorial_testing.claims import claim
from tutorial_testing.session_room import ANNA, BOB, Free, Graphs, look, page

pytestmark = claim(
    "What a page publishes by a form ends when the page is silent, late, hidden, gone or must not; "
    "what moves a robot makes the page the driver, by name; Stop of any page that may drive ends "
    "that; each end publishes one zero within 0.6 s, at any rate and once"
)
TEXT = "std_msgs/String"
VALUES = {VELOCITY: {"linear/x": "1"}, TEXT: {"data": "a"}, JOY: {"axes": "[1]", "buttons": "[1]"}}
TICK_S, BEAT_S = 0.01, 0.05
REST = {VELOCITY: 0.0, JOY: (0.0,)}
LOST_S, ONCE = 0.6, 0.0  # The zero's deadline [s]; the period for a message that is published once.


def value_of(message):
    if message._type == JOY:
        return tuple(message.axes)
    return message.linear.x if message._type == VELOCITY else message.data


class Desk:
    """Anna's page, which publishes from 100 s on, Bob's page, and a clock that is a number."""

    def __init__(self, kind=VELOCITY, period=0.1):
        self.driving, self.now, self.published = Free(), 100.0, []
        kept = Outlets()
        self.repeats = Publishing(self.driving, Graphs(), kept)
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
        is_due = self.period > 0 and self.step % self.steps == 0
        beat = next((said["n"] for said in self.anna[1][::-1] if said["kind"] == "beat"), 0)
        t = 1000 * (self.now - self.network_s)
        self.repeats.on_again(self.anna[0], self.now, n=self.n, t=t, beat=beat, due=is_due)

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


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    monkeypatch.setattr(rospy.Time, "now", lambda: rospy.Time(7))


# How the operator of a form is lost, or stops publishing.
ENDS = {
    "page closed, or killed": Desk.close,
    "page frozen, or its cable cut": Desk.fall_silent,
    "network slow": Desk.delay,
    "page hidden, or Stop publishing": lambda desk: desk.repeats.on_publish_end(desk.anna[0], 0.0),
    "its Stop": lambda desk: desk.driving.on_stop(desk.anna[0], desk.now),
    "Stop of another page": lambda desk: desk.driving.on_stop(desk.bob[0], desk.now),
    "server ended, or its master gone": lambda desk: desk.driving.session.end(),
}


@pytest.mark.parametrize("kind", [VELOCITY, JOY])
@pytest.mark.parametrize("period", [ONCE, 10.0, 1.0, 0.1, 0.02])
@pytest.mark.parametrize("end", ENDS)
def test_each_end_of_a_motion_publishes_one_zero_in_time_and_nothing_more(end, period, kind):
    desk = Desk(kind, period)
    desk.pass_time(10.4)
    moving = value_of(outlets.filled(outlets.message_class(kind), VALUES[kind]))
    count = len(desk.published)
    assert desk.values == [moving] * count
    assert count >= (10.2 / period if period else 1) and desk.driving.session.driver == ANNA
    lost_at = desk.now
    ENDS[end](desk)
    desk.pass_time(11.0)
    at, value = desk.published[-1]
    assert value == REST[kind] and at - lost_at < LOST_S and desk.driving.session.driver is None
    *rest, _ = desk.values[count:]
    assert rest == [moving] * len(rest) and len(rest) <= 1 + 0.25 / (period or 1)
    count = len(desk.published)
    desk.is_silent, desk.network_s = False, 0.0
    desk.pass_time(0.5)  # the page is back: a person has to start again
    assert len(desk.published) == count


def test_what_moves_nothing_ends_with_its_page_and_makes_no_driver():
    desk = Desk(TEXT)
    desk.pass_time(1.0)
    assert 10 <= len(desk.published) <= 11 and desk.driving.session.driver is None
    count = len(desk.published)
    desk.is_silent = True
    desk.pass_time(0.5)
    assert (len(desk.published), desk.anna[1][-1]["why"]) == (count, publishing.SILENT)
    desk.is_silent = False
    desk.pass_time(0.5)
    assert len(desk.published) == count
    desk = Desk(VELOCITY, ONCE)
    desk.driving.on_stop(desk.anna[0], desk.now)
    desk.publish({})  # a zero, once
    assert desk.values == [1.0, 0.0, 0.0] and desk.driving.session.driver is None


def test_the_page_of_a_form_is_the_driver_by_name_and_others_are_refused():
    desk = Desk(VELOCITY, ONCE)
    desk.pass_time(0.1)
    for viewer, yours, who in (
        (desk.anna, True, "You drive by a form, on /cmd_vel."),
        (desk.bob, False, "Page 2 (10.0.0.1) drives by a form, on /cmd_vel."),
    ):
        viewer[0].watch.look = "another"
        said = {message["kind"]: message for message in look(desk.driving, viewer)[0]}
        assert (said["session"]["yours"], said["session"]["topic"]) == (yours, "/cmd_vel")
        assert said["drives"]["who"].replace("Page 1", "Page 2") == who
    bob = desk.bob[0]
    form = {"topic": "/x", "type": TEXT, "values": {}, "period": None}
    with pytest.raises(RefusedError, match="another page drives"):
        desk.repeats.on_publish(bob, desk.now, **form)
    assert "Stop ends that" in desk.driving.session.refusal(BOB)
    with pytest.raises(RefusedError, match="only the page that drives"):
        desk.driving.on_hand_over(desk.anna[0], desk.now, BOB)
    desk.repeats.on_publish(desk.anna[0], desk.now, **form)  # while the first form moves the robot
    assert desk.driving.session.driver == ANNA


def test_another_page_that_drives_ends_what_repeats():
    desk = Desk(TEXT)
    desk.driving.session.take(BOB, "", desk.now)
    with pytest.raises(RefusedError, match="another page drives"):
        desk.pass_time(0.2)
    count = len(desk.published)
    desk.pass_time(0.3)
    assert len(desk.published) == count


def test_a_page_repeats_one_message():
    desk = Desk()
    desk.publish({})
    assert desk.values == [1.0, 0.0, 0.0]  # the zero of the first one's end, then the second one


def test_a_hand_that_drives_lets_go_for_the_form():
    desk = Desk(VELOCITY, ONCE)
    desk.driving.session.take(ANNA, "ada", desk.now)
    assert desk.values == [1.0, 0.0]
    desk.publish(VALUES[VELOCITY])
    assert desk.driving.session.topic == "/cmd_vel"


def test_nothing_is_published_after_the_end_of_the_server():
    desk = Desk(VELOCITY, ONCE)
    desk.driving.session.end()
    with pytest.raises(RefusedError, match="being shut down"):
        desk.publish(VALUES[VELOCITY])
    assert desk.values == [1.0, 0.0]


def test_the_first_message_waits_for_the_subscribers(monkeypatch):
    sent = []
    publisher = SimpleNamespace(publish=sent.append, names={"/a"})
    monkeypatch.setattr(outlets, "PromptPublisher", lambda *_: publisher)
    for wanted, counts in (({"/a"}, [1, 1, 1]), ({"/b"}, [1, 1, 2])):
        outlet = Outlet(0.0, 0.0, "message")
        outlet.open("/x", None)
        assert [outlet.send_first(wanted, now) or len(sent) for now in (0.0, 0.5, 1.1)] == counts
