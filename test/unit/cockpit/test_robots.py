"""What pages are sent of robots."""

from math import inf, nan
from types import SimpleNamespace

import pytest
from nav_msgs.msg import Odometry

from cockpit_server.graph import JOY, ODOMETRY, Graph, topic_of
from cockpit_server.motion import Motion, covered
from cockpit_server.sources.robots import Robots, shown
from tutorial_testing.session_room import Topics, look, page


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


def test_page_gets_all_robots_also_while_they_stand():
    topics, graphs = Topics(), SimpleNamespace(graph=graph("ada", "bob"))
    robots, one = Robots(topics, graphs), page(robots=True)

    def place(robot, x):
        odometry = Odometry()
        odometry.pose.pose.position.x = x
        topics.hear(f"/{robot}/odom", odometry)

    def seen():
        newest = next(said for said in look(robots, one)[0] if said["kind"] == "robots")
        return {name: state["x"] for name, state in newest["robots"].items()}

    assert seen() == {}
    for robot in ("ada", "bob"):
        place(robot, 1.0)
    assert seen() == {"ada": 1.0, "bob": 1.0}
    place("bob", 2.0)
    assert [seen(), seen()] == [{"ada": 1.0, "bob": 2.0}] * 2  # that the server is there
    graphs.graph = graph("bob")
    assert seen() == {"bob": 2.0}
