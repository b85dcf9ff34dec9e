"""What pages are sent of robots and of their joysticks."""

from math import inf, nan
from types import SimpleNamespace

import pytest
from kobuki_msgs.msg import Led, Sound
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from std_msgs.msg import Header

from cockpit_server.graph import JOY, ODOMETRY, Graph, topic_of
from cockpit_server.motion import Motion
from cockpit_server.sources import robots as robots_module
from cockpit_server.sources.robots import LONGEST_JOY, Pads, Robots, joy_shown, shown
from tutorial_testing.seat_room import Topics, look, page, serialised


def graph(*robots, **types):
    """These robots with an odometry, and robot_9, which only hears a joystick."""
    return Graph(
        publishers={topic_of(robot, "odom"): {"/sim"} for robot in robots},
        subscribers={"/robot_9/joy": {"/joy2twist"}},
        types={"/robot_9/joy": JOY, **{topic_of(r, "odom"): ODOMETRY for r in robots}, **types},
    )


def of(kind, sent):
    return next((message for message in sent if message["kind"] == kind), None)


def test_names_of_robots_come_when_they_change_to_pages_that_look_at_robots():
    graphs = SimpleNamespace(graph=graph("robot_2", "robot_1"))
    robots, pages = Robots(Topics(), graphs), (page(robots=True), page())
    sent, nothing = look(robots, *pages)
    assert of("names", sent)["names"] == ["robot_1", "robot_2", "robot_9"]
    assert nothing == []
    assert of("names", look(robots, *pages)[0]) is None
    graphs.graph = graph("robot_1")
    assert of("names", look(robots, *pages)[0])["names"] == ["robot_1", "robot_9"]


def test_pages_get_what_a_kobuki_was_last_asked_for():
    here, there = "/ada/mobile_base/commands/led1", "/mobile_base/commands/sound"
    kinds = {here: "kobuki_msgs/Led", there: "kobuki_msgs/Sound", "/other/led1": "x/Led"}
    topics, one = Topics(), page(robots=True)
    robots = Robots(topics, SimpleNamespace(graph=graph("ada", "", **kinds)))
    look(robots, one)
    assert {here, there} < set(topics.hears) and "/other/led1" not in topics.hears
    for topic in ("/ada/odom", "/odom"):
        topics.hear(topic, Odometry())
    for topic, message in (
        (here, Led(Led.ORANGE)),
        (there, Sound(Sound.CLEANINGEND)),
        (here, Led(9)),
    ):
        topics.hear(topic, message)
    seen = of("robots", look(robots, one)[0])["robots"]
    assert (seen["ada"]["led1"], seen[""]["sound"]) == ("orange", "cleaningend")
    assert "sound" not in seen["ada"] and "led1" not in seen[""]


@pytest.mark.parametrize(
    ("wrong", "left_out"),
    [
        ({}, set()),
        *[(wrong, {"x", "y", "yaw"}) for wrong in ({"x": nan}, {"y": inf}, {"yaw": nan})],
        *[(wrong, {"x", "y", "yaw"}) for wrong in ({"x": 1e6 + 1}, {"y": -1e300})],
        ({"w": nan}, {"w"}),
    ],
)
def test_impossible_place_is_left_out(wrong, left_out):
    state = Motion(1.0, -1e6, 0.5, 0.25, -0.5)._replace(**wrong)
    everything = {"x", "y", "yaw", "v", "w", "covered", "age"}
    assert set(shown(state, 1.0, 2.0, 3.0)) == everything - left_out
    assert [shown(state, 1.0, 2.0, now)["age"] for now in (0.9, 1.9, 2.1)] == [0, 0, 1]


def test_page_gets_only_the_robots_that_changed_since_it_was_sent_some():
    topics, graphs = Topics(), SimpleNamespace(graph=graph("ada", "bob"))
    robots, one, late = Robots(topics, graphs), page(robots=True), page(robots=True)

    def place(robot, x):
        odometry = Odometry()
        odometry.pose.pose.position.x = x
        topics.hear(f"/{robot}/odom", odometry)

    def seen(*pages):
        newest = of("robots", look(robots, *pages)[0])
        return newest["all"], {name: state["x"] for name, state in newest["robots"].items()}

    assert seen(one) == (True, {})
    for robot in ("ada", "bob"):
        place(robot, 1.0)
    assert seen(one) == (True, {"ada": 1.0, "bob": 1.0})
    place("ada", 1.0)
    assert seen(one) == (False, {})  # it stands; the message still says that the server is there
    place("bob", 2.0)
    robots.prepare([one[0]], 0.0)  # the page is behind
    assert seen(one) == (False, {"bob": 2.0})
    assert seen(late) == (True, {"ada": 1.0, "bob": 2.0})
    graphs.graph = graph("bob")
    assert seen(one) == (True, {"bob": 2.0})  # so ada is gone


def test_joystick_is_shown_finite_and_up_to_a_length():
    joy = Joy(axes=[0.123456, inf], buttons=[1, 0])
    assert joy_shown(serialised(joy)) == {"axes": [0.1235, 0.0], "buttons": [1, 0]}
    assert joy_shown(b"none") is None
    joy = Joy(buttons=[0] * ((LONGEST_JOY - 24) // 4))  # beside header and two lengths
    assert len(serialised(joy)) == LONGEST_JOY == 4000
    assert joy_shown(serialised(joy)) == {"axes": [], "buttons": joy.buttons}
    joy.header = Header(frame_id="x")
    assert joy_shown(serialised(joy)) is None


@pytest.fixture
def pads(monkeypatch):
    """(Pads of the robot robot_1, its Topics); messages come from the node /other."""
    monkeypatch.setattr(robots_module, "sender_of", lambda message: "/other")
    topics = Topics()
    return Pads(topics, SimpleNamespace(graph=graph("robot_1")), "/cockpit"), topics


def test_joystick_message_is_read_once_for_all_pages(pads, monkeypatch):
    pads, topics = pads
    read = []
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: read.append(data) or {"axes": []})
    one, other, _ = pages = [page(look=r) for r in ("robot_1", "robot_1", "no/such/robot")]
    look(pads, *pages)
    assert set(topics.hears) == {"/robot_1/joy"}
    for data in (b"1", b"2"):
        topics.hear("/robot_1/joy", data)
        assert [len(sent) for sent in look(pads, *pages)] == [1, 1, 0]
        assert look(pads, *pages) == [[], [], []]
    assert read == [b"1", b"2"]
    other[0].watch.look = None
    look(pads, one, other)
    other[0].watch.look = "robot_1"
    assert [len(sent) for sent in look(pads, one, other)] == [0, 1]  # it looks back


def test_other_joystick_is_a_rival_whatever_is_in_its_message(pads, monkeypatch):
    pads, topics = pads
    look(pads, page(look="robot_1"))
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: [].pop())
    with pytest.raises(IndexError):
        topics.hear("/robot_1/joy", b"")
    assert pads.rival("robot_1", 0.0) == "/other"
    assert pads.rival("robot_1", inf) is None
