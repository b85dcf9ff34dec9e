"""What pages are sent of robots."""

from math import inf, nan

import pytest
from geometry_msgs.msg import Quaternion, Transform, Vector3
from kobuki_msgs.msg import SensorState
from nav_msgs.msg import Odometry

from cockpit_server.graph import JOY, ODOMETRY, Graph, topic_of
from cockpit_server.tabs.motion import Motion, covered
from cockpit_server.tabs.robots import Robots, shown
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, Topics, look, page

pytestmark = claim("All robots are shown, impossible places are left out")


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
    seen = shown(state, 1.0, 2.0, state, 3.0)
    assert set(seen["truth"]) == PLACE - left_out
    assert set(seen) == {*PLACE, "v", "w", "covered", "age", "truth"} - left_out


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_way_grows_only_by_driving(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)


class Seen(Topics):
    """A page that looks at robots."""

    def __init__(self, graph):
        super().__init__()
        self.graphs = Graphs(graph)
        self.robots, self.page = Robots(self, self.graphs), page(robots=True, floor=True)
        self.look()

    def look(self, now=0.0):
        """Return the robots that the page is sent at a time [s]."""
        [[newest]] = look(self.robots, self.page, now=now)
        return newest["robots"]

    def place(self, topic, x, frame=""):
        odometry = Odometry()
        odometry.header.frame_id = frame
        odometry.pose.pose.position.x = x
        self.hear(topic, odometry)


def test_page_gets_all_robots_also_while_they_stand():
    seen = Seen(graph("ada", "bob"))
    assert seen.look() == {"ada": {}, "bob": {}, "robot_9": {}}
    for robot, x in (("ada", 1.0), ("bob", 2.0)):
        seen.place(f"/{robot}/odom", x)
    for _ in range(2):  # sent again, as a sign of the server's life
        assert [state.get("x") for state in seen.look().values()] == [1.0, 2.0, None]
    seen.graphs.graph = graph("bob")
    assert list(seen.look()) == ["bob", "robot_9"]


def test_a_robot_has_its_place_in_the_map_and_its_pressed_bumpers():
    bumper = "/ada/mobile_base/events/bumper"
    types = {"/ada/odom": ODOMETRY, "/ada/base_pose_ground_truth": ODOMETRY,
             bumper: "kobuki_msgs/BumperEvent"}  # fmt: skip
    seen = Seen(Graph(publishers={topic: {"/sim"} for topic in types}, types=types))
    seen.place("/ada/base_pose_ground_truth", 1.0)
    seen.place("/ada/odom", 2.0)
    assert seen.look()["ada"]["truth"] == {"x": 1.0, "y": 0.0, "yaw": 0.0}
    malformed = [(data, [1]) for data in (b"", b"\1", b"\3\1", b"\0\1\1")]
    for data, pressed in [(b"\1\1", [1]), *malformed, (b"\0\1", [0, 1]), (b"\1\0", [0])]:
        seen.hear(bumper, data)
        assert seen.look()["ada"]["bumpers"] == pressed


def test_place_in_the_map_is_that_of_tf_without_a_ground_truth():
    """As gmapping and amcl publish it."""
    seen = Seen(graph("ada"))
    to_map = Transform(Vector3(5.0, 1.0, 0.0), Quaternion(0.0, 0.0, 1.0, 1.0))  # by 90 degrees
    seen.robots.transform_to_map = {"ada/odom": to_map}.get
    seen.place("/ada/odom", 2.0)
    assert seen.look()["ada"]["truth"] == {}
    seen.place("/ada/odom", 2.0, frame="/ada/odom")
    assert seen.look()["ada"]["truth"] == {"x": 5.0, "y": 3.0, "yaw": 1.5708}


CORE = "/ada/mobile_base/sensors/core"


def with_core():
    """Return a page that shows ada, which has a Kobuki's sensors, as bob has."""
    cores = {CORE: "kobuki_msgs/SensorState", CORE.replace("ada", "bob"): "kobuki_msgs/SensorState"}
    both = graph("ada", "bob")
    publishers = {**both.publishers, **{topic: {"/base"} for topic in cores}}
    seen = Seen(Graph(publishers, both.subscribers, types={**both.types, **cores}))
    seen.page = page(robots=True, floor=True, look="ada")
    return seen


@pytest.mark.parametrize(
    ("core", "words"),
    [
        ((0, 0, 0, 164), ("16.4", "none", "none", "none")),
        ((5, 1, 22, 131), ("13.1", "adapter, charging", "0, 2", "right")),
        ((2, 3, 6, 140), ("14.0", "dock, charging", "1", "left, right")),
        ((0, 2, 18, 165), ("16.5", "adapter, charged", "none", "left")),
        ((0, 0, 9, 0), ("0.0", "unknown (9)", "none", "none")),
    ],
)
def test_the_chosen_robot_shows_battery_charger_buttons_and_wheel_drops(core, words):
    seen = with_core()
    seen.look(100.0)
    assert CORE.replace("ada", "bob") not in seen.handlers  # no page shows it
    buttons, drops, charger, battery = core
    message = SensorState(buttons=buttons, wheel_drop=drops, charger=charger, battery=battery)
    seen.hear(CORE, message, now=100.0)
    names = ("battery", "charger", "buttons", "wheel_drops")
    for now, expected in ((101.9, words), (102.0, (None,) * 4)):  # unknown after 2 s of silence
        assert tuple(map(seen.look(now)["ada"].get, names)) == expected


def test_malformed_sensors_show_nothing():
    seen = with_core()
    seen.look(100.0)
    seen.hear(CORE, b"no sensors", now=100.0)
    assert seen.look(100.0)["ada"] == {}


def test_a_page_whose_floor_is_hidden_gets_the_speed_of_its_robot_alone():
    """All robots at first, for its list of them, and again when others come or go."""
    seen = Seen(graph("ada", "bob"))
    hidden = page(robots=True, look="ada")
    sent = lambda now: look(seen.robots, hidden, now=now)[0]  # noqa: E731
    assert [message["kind"] for message in sent(0.0)] == ["robots"]
    seen.place("/ada/odom", 1.0)
    speeds = [message for at in range(21) for message in sent(1.0 + at / 20)]
    assert [message["kind"] for message in speeds] == ["speed"] * 5
    assert set(speeds[0]) == {"kind", "v", "w", "age"}
    seen.graphs.graph = graph("ada")
    assert [message["kind"] for message in sent(3.0)] == ["robots"]
