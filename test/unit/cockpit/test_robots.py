"""What pages are sent of robots and of their joysticks."""

from math import inf, nan
from types import SimpleNamespace

import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.graph import JOY, ODOMETRY, Graph, topic_of
from cockpit_server.motion import Motion, covered
from cockpit_server.sources import robots as robots_module
from cockpit_server.sources.robots import LONGEST_JOY, Pads, Robots, joy_shown, shown
from tutorial_testing.session_room import Topics, look, page, serialised


def graph(*robots):
    """These robots with an odometry, and robot_9, which only receives a joystick."""
    return Graph(
        publishers={topic_of(robot, "odom"): {"/sim"} for robot in robots},
        subscribers={"/robot_9/joy": {"/joy2twist"}},
        types={"/robot_9/joy": JOY, **{topic_of(robot, "odom"): ODOMETRY for robot in robots}},
    )


PLACE = {"x", "y", "yaw"}


@pytest.mark.parametrize(
    ("wrong", "left_out"),
    [({}, set()), ({"x": nan}, PLACE), ({"y": inf}, PLACE), ({"yaw": nan}, PLACE),
     ({"x": 1e6 + 1}, PLACE), ({"w": nan}, {"w"})],
)  # fmt: skip
def test_impossible_place_is_left_out(wrong, left_out):
    state = Motion(1.0, -1e6, 0.5, 0.25, -0.5)._replace(**wrong)
    assert set(shown(state, 1.0, 2.0, 3.0)) == {*PLACE, "v", "w", "covered", "age"} - left_out


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_way_grows_only_by_driving(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)


def test_page_gets_only_the_robots_that_changed_since_it_was_sent_some():
    topics, graphs = Topics(), SimpleNamespace(graph=graph("ada", "bob"))
    robots, one, late = Robots(topics, graphs), page(robots=True), page(robots=True)

    def place(robot, x):
        odometry = Odometry()
        odometry.pose.pose.position.x = x
        topics.hear(f"/{robot}/odom", odometry)

    def seen(*pages):
        [newest] = [sent for sent in look(robots, *pages)[0] if sent["kind"] == "robots"]
        return newest["all"], {name: state["x"] for name, state in newest["robots"].items()}

    assert seen(one) == (True, {})
    for robot in ("ada", "bob"):
        place(robot, 1.0)
    assert seen(one) == (True, {"ada": 1.0, "bob": 1.0})
    place("ada", 1.0)
    assert seen(one) == (False, {})  # it stands; the message still says that the server is there
    place("bob", 2.0)
    robots.collect([one[0]], 0.0)  # the page is behind
    assert seen(one) == (False, {"bob": 2.0})
    assert seen(late) == (True, {"ada": 1.0, "bob": 2.0})
    graphs.graph = graph("bob")
    assert seen(one) == (True, {"bob": 2.0})  # so ada is gone


def test_joystick_is_shown_finite_and_up_to_a_length():
    joy = Joy(axes=[0.123456, inf], buttons=[1, 0])
    assert joy_shown(serialised(joy)) == {"axes": [0.1235, 0.0], "buttons": [1, 0]}
    assert joy_shown(b"none") is None
    assert joy_shown(serialised(Joy(buttons=[0] * LONGEST_JOY))) is None


@pytest.fixture
def pads(monkeypatch):
    """(Pads of the robot robot_1, its Topics); messages come from the node /other."""
    monkeypatch.setattr(robots_module, "sender_of", lambda message: "/other")
    topics = Topics()
    return Pads(topics, SimpleNamespace(graph=graph("robot_1")), "/cockpit"), topics


def test_other_joystick_is_a_rival_whatever_is_in_its_message(pads, monkeypatch):
    pads, topics = pads
    one = page(look="robot_1")
    look(pads, one)
    topics.hear("/robot_1/joy", Joy())
    assert [len(look(pads, one)[0]) for _ in range(2)] == [1, 0]  # each is sent once
    monkeypatch.setattr(robots_module, "joy_shown", lambda data: [].pop())
    with pytest.raises(IndexError):
        topics.hear("/robot_1/joy", b"")
    assert pads.rival("robot_1", 0.0) == "/other"
    assert pads.rival("robot_1", inf) is None
