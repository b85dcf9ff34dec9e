"""Forms that publish: when they end, and that one that moves a robot makes its page the driver."""

import pytest
import rospy

from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY
from cockpit_server.ros.tabs import outlets
from cockpit_server.tabs.publishing import SILENCE_AT_REST_S, SILENT, VELOCITY
from tutorial_testing.claims import claim
from tutorial_testing.form_desk import ONCE, TEXT, VALUES, Desk, Several, value_of
from tutorial_testing.session_room import ANNA, BOB, look

pytestmark = claim(
    "What a page publishes by a form ends when the page is silent, late, hidden, gone or must not; "
    "what moves a robot makes the page the driver, by name; Stop of any page that may drive ends "
    "that; each end publishes one zero within 0.6 s, at any rate and once"
)
REST = {VELOCITY: 0.0, JOY: (0.0,)}
LOST_S = 0.6  # the zero's deadline [s]


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    monkeypatch.setattr(rospy.Time, "now", lambda: rospy.Time(7))


# How the operator of a form is lost, or stops publishing.
ENDS = {
    "page closed, or killed": Desk.close,
    "page frozen, or its cable cut": Desk.fall_silent,
    "network slow": Desk.delay,
    "page hidden, or Stop all": lambda desk: desk.repeats.on_publish_end(desk.anna[0], 0.0, None),
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


@pytest.mark.parametrize("end", ENDS)
def test_each_end_of_the_page_ends_all_and_stop_ends_only_the_motion(end):
    desk = Several()
    desk.pass_time(2.0)
    assert 19 <= desk.counts["/cmd_vel"] <= 21 and desk.counts["/a"] in (4, 5)
    assert desk.counts["/b"] == len(desk.on("/b")) in (20, 21)
    ENDS[end](desk)
    desk.pass_time(LOST_S)
    assert desk.on("/cmd_vel")[-1] == 0.0 and desk.on("/cmd_vel").count(0.0) == 1
    desk.pass_time(SILENCE_AT_REST_S)
    desk.published.clear()
    desk.is_silent, desk.network_s = False, 0.0
    desk.pass_time(1.0)
    goes_on = end in ("its Stop", "Stop of another page", "server ended, or its master gone")
    assert {topic for topic, _ in desk.published} == ({"/a", "/b"} if goes_on else set())
    assert list(desk.counts) == (["/a", "/b"] if goes_on else [])


def test_each_topic_has_its_own_stop():
    desk = Several()
    desk.pass_time(0.3)
    desk.repeats.on_publish_end(desk.anna[0], desk.now, "/b")
    assert list(desk.counts) == ["/cmd_vel", "/a"] and desk.driving.session.topic == "/cmd_vel"
    desk.repeats.on_publish_end(desk.anna[0], desk.now, "/cmd_vel")
    assert list(desk.counts) == ["/a"] and desk.on("/cmd_vel")[-1] == 0.0
    desk.repeats.on_publish_end(desk.anna[0], desk.now, "/nothing")
    count = len(desk.on("/b"))
    desk.pass_time(1.0)
    assert len(desk.on("/b")) == count and desk.counts["/a"] > 2


@pytest.mark.parametrize(
    ("texts", "why"),
    [
        ("sqrt(4.5 - i)", "linear/x: .*domain error .message 5 on /cmd_vel"),
        ("1e308 * 10 ** (i - 4)", "linear/x: .*it is inf .message 5 on /cmd_vel"),
        ("1 / (i - 5)", "linear/x: .*division by zero .message 5 on /cmd_vel"),
    ],
)
def test_an_expression_that_fails_ends_its_motion_with_a_zero_and_nothing_else(texts, why):
    desk = Several()
    desk.add("/cmd_vel", VELOCITY, 0.1, **{"linear/x": texts})
    desk.published.clear()
    with pytest.raises(RefusedError, match=why):
        desk.pass_time(2.0)
    desk.pass_time(1.0)
    assert desk.on("/cmd_vel")[-1] == 0.0 and desk.on("/cmd_vel").count(0.0) == 1
    assert desk.driving.session.driver is None and list(desk.counts) == ["/a", "/b"]
    with pytest.raises(ValueError, match=r"linear/x: .*division by zero$"):  # at once: nothing ends
        desk.add("/a", VELOCITY, 0.1, **{"linear/x": "1 / 0"})
    assert list(desk.counts) == ["/a", "/b"]


def test_a_page_publishes_on_eight_topics_and_a_hundred_messages_a_second_in_all():
    desk = Several()
    for number in range(5):
        desk.add(f"/{number}", TEXT, 10.0)
    for topic, period in (("/9", 10.0), ("/a", 0.0125)):
        with pytest.raises(RefusedError, match="at most on 8 topics, 100 messages per second"):
            desk.add(topic, TEXT, period)
    desk.add("/a", TEXT, 0.02)
    assert len(desk.counts) == 8
    kept = desk.repeats._publishers._outlets["/4", TEXT]
    desk.pass_time(9.0)  # between two messages of a topic its publisher stays open
    assert kept.used_at > desk.now - 1 and desk.counts["/4"] == 1


def test_a_page_that_publishes_nothing_is_sent_nothing_and_then_each_change():
    desk = Desk(TEXT, ONCE)
    client, said = desk.anna
    for _ in range(2):
        desk.repeats.send_to(client, desk.now)
    assert said == []
    desk.period = 0.1
    desk.publish({})
    its = {"topic": "/cmd_vel", "type": TEXT, "period": 0.1, "count": 1}
    for _ in range(2):
        desk.repeats.send_to(client, desk.now)
    desk.repeats.on_publish_end(client, desk.now, None)
    for _ in range(2):
        desk.repeats.send_to(client, desk.now)
    assert said == [{"kind": "running", "topics": [its]}, {"kind": "running", "topics": []}]


def test_what_moves_nothing_ends_with_its_page_and_makes_no_driver():
    desk = Desk(TEXT)
    desk.pass_time(1.0)
    assert 10 <= len(desk.published) <= 11 and desk.driving.session.driver is None
    count = len(desk.published)
    desk.is_silent = True
    desk.pass_time(1.9)
    desk.is_silent = False
    desk.pass_time(0.5)  # A busy page goes on.
    assert count < len(desk.published) <= count + 6
    count = len(desk.published)
    desk.is_silent = True
    desk.pass_time(2.1)
    assert (len(desk.published), desk.anna[1][-1]["why"]) == (count, f"/cmd_vel: {SILENT}")
    desk.is_silent = False
    desk.pass_time(0.5)
    assert len(desk.published) == count
    desk = Desk(TEXT)
    desk.is_silent = True
    desk.pass_time(0.3)  # until the page is sent what runs, and its first sign has arrived
    desk.is_silent = False
    desk.pass_time(1.0)
    assert len(desk.published) > 9
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


def test_a_page_has_one_motion_and_one_message_on_a_topic():
    desk = Desk()
    desk.publish({})
    assert desk.values == [1.0, 0.0, 0.0]  # the zero of the first one's end, then the second one
    desk = Several()
    desk.add("/b", TEXT, 0.1, data="c")
    desk.pass_time(1.0)
    assert "b" not in desk.on("/b")[1:] and desk.counts["/b"] in (10, 11)
    desk.add("/other", VELOCITY, 0.1, **{"linear/x": "2"})
    assert (desk.on("/cmd_vel")[-1], desk.driving.session.topic) == (0.0, "/other")
    assert list(desk.counts) == ["/a", "/b", "/other"]


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
