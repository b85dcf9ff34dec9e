"""Scans, paths and markers for pages that show the floor, and the frame of the floor."""

from types import SimpleNamespace

import pytest
from geometry_msgs.msg import Point, PoseStamped, Transform, Vector3
from nav_msgs.msg import Path
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

from cockpit_server.graph import ODOMETRY, Graph
from cockpit_server.tabs import overlays
from cockpit_server.tabs.robots import Robots
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, Topics, page

TYPES = {
    "/ada/odom": ODOMETRY, "/ada/scan": LaserScan._type, "/ada/plan": Path._type,
    "/bob/odom": ODOMETRY, "/bob/scan": LaserScan._type,
    "/lidar": LaserScan._type, "/marks": MarkerArray._type, "/mark": Marker._type,
    "/world_markers": MarkerArray._type, "/bob/bumper_markers": MarkerArray._type,
    "/classroom_bodies": MarkerArray._type, "/goal": "geometry_msgs/PoseStamped",
}  # fmt: skip


class Tf:
    """Replaces Transforms: frames on the x axis, by the position of each [m]."""

    def __init__(self):
        self.places, self.is_needed, self.stamps = {}, False, []

    def set_needed(self, _owner, is_needed):
        self.is_needed = is_needed

    def lookup(self, target, source, stamp=None):
        self.stamps.append(stamp and stamp.to_sec())
        if {target, source} - set(self.places):
            return None, "unknown"
        return Transform(translation=Vector3(self.places[source] - self.places[target], 0, 0)), ""


def at_once(action, *arguments):
    """Replaces a thread."""
    result = action(*arguments)
    return SimpleNamespace(done=lambda: True, result=lambda: result)


class Floor(Topics):
    """The Overlays of two robots, and a page that shows the floor with ada in sight."""

    def __init__(self, types=TYPES, subscribers=()):
        super().__init__()
        self.tf, self.wants = Tf(), {}
        self.robots, self.maps = Robots(self, Graphs()), SimpleNamespace(frame="")
        graph = Graph({t: {"/a"} for t in types}, {t: {"/b"} for t in subscribers}, types=types)
        self.graphs = Graphs(graph)
        self.source = overlays.Overlays(self, self.graphs, self.tf, self.robots, self.maps, at_once)
        self.page, self.sent = page(floor=True, look="ada")
        self.look()

    def set_subscriptions(self, owner, handlers, every):
        self.wants[owner] = dict(handlers)
        self.handlers = {t: h for wanted in self.wants.values() for t, h in wanted.items()}

    def look(self, now=0.0):
        """Return the shapes that the page is sent at a time [s], by topic; "floor": its fields."""
        self.sent.clear()
        self.source.collect([self.page], now)
        self.source.send_to(self.page, now)
        return {m.get("topic", m["kind"]): m.get("shapes", m) for m in self.sent}

    def points(self, topic, now=0.0):
        return [shape["points"] for shape in self.look(now)[topic]]


@pytest.fixture
def floor():
    return Floor()


def framed(message, frame, secs=0):
    message.header.frame_id, message.header.stamp.secs = frame, secs
    return message


def scan(frame, ahead=1.0, secs=0):
    return framed(LaserScan(ranges=[ahead], range_max=9.0), frame, secs)


def dot(frame="odom", number=0, **fields):
    message = Marker(type=Marker.POINTS, id=number, points=[Point(1.0, 0.0, 0.0)], **fields)
    return framed(message, frame)


def path(frame, *xs):
    message = Path(poses=[PoseStamped() for _ in xs])
    for stamped, x in zip(message.poses, xs):
        stamped.pose.position.x = x
    return framed(message, frame)


@claim("The floor subscribes to what it shows of the robot in sight, and otherwise to nothing")
def test_topics_of_a_floor(floor):
    assert set(floor.handlers) == {"/ada/scan", "/ada/plan", "/lidar", "/marks", "/mark"}
    assert not floor.tf.is_needed
    floor.page.watch.look = "bob"
    floor.look()
    assert set(floor.handlers) == {"/bob/scan", "/lidar", "/marks", "/mark"}
    floor.page.watch.floor = False
    floor.look()
    assert floor.handlers == {}


def test_robot_without_a_namespace_has_what_belongs_to_no_other():
    kinds = {"odom": ODOMETRY, "scan": LaserScan._type}
    floor = Floor({f"{robot}/{name}": kinds[name] for robot in ("", "/ada") for name in kinds})
    assert set(floor.handlers) == {"/ada/scan"}
    floor.page.watch.look = ""
    floor.look()
    assert set(floor.handlers) == {"/scan"}


@claim("The floor's frame is that of its map, its robot's odometry, or else of what it shows")
def test_frame_of_the_floor():
    floor = Floor(subscribers=["/ada/initialpose", "/bob/move_base_simple/goal"])
    frame = lambda: floor.look(now=overlays.AGAIN_S)["floor"]["frame"]  # noqa: E731
    floor.page.seen.clear()
    first = floor.look()["floor"]
    assert (first["frame"], first["subscribed"]) == ("map", ["initialpose"])
    floor.hear("/lidar", scan("laser"))
    floor.look()
    assert frame() == "laser"
    floor.tf.places = {"laser": 0.0, "odom": 0.0}
    assert frame() == "odom"
    floor.robots.frames["ada"] = "ada/odom"
    assert frame() == "ada/odom"
    floor.maps.frame = "world"
    assert frame() == "world"


@claim("Scans, paths and markers stand where tf has their frames at their time")
def test_shapes_are_placed_by_tf(floor):
    floor.maps.frame = "map"
    floor.hear("/lidar", scan("laser", ahead=2.0, secs=7))
    floor.hear("/ada/plan", path("odom", 0.0, 3.0))
    floor.hear("/mark", dot())
    assert floor.look() == {}
    assert floor.tf.is_needed and 7.0 in floor.tf.stamps
    floor.tf.places = {"map": 0.0, "laser": 10.0, "odom": 20.0}
    shown = floor.look(now=overlays.AGAIN_S)
    lidar = {"as": "dots", "points": [[12.0, 0.0]], "colour": "--scan", "size": 0}
    assert shown["/lidar"] == [lidar]
    assert [shape["points"] for shape in shown["/ada/plan"]] == [[[20.0, 0.0], [23.0, 0.0]]]
    assert [shape["points"] for shape in shown["/mark"]] == [[[21.0, 0.0]]]
    floor.tf.places["odom"] = 30.0  # They stay where they were, as in RViz.
    assert floor.look(now=1.0) == {}


@claim("Without a ground truth a robot is in the map where tf has its odometry")
def test_tf_is_needed_for_a_robot_in_a_map(floor):
    floor.maps.frame, floor.robots.frames["ada"] = "map", "odom"
    floor.look()
    assert floor.tf.is_needed
    assert floor.robots.transform_to_map("odom") is None
    floor.tf.places = {"map": 0.0, "odom": 3.0}
    assert floor.robots.transform_to_map("odom").translation.x == 3.0
    publishers = {**floor.graphs.graph.publishers, "/ada/base_pose_ground_truth": {"/sim"}}
    floor.graphs.graph = Graph(publishers, types=TYPES)
    floor.look()
    assert not floor.tf.is_needed
    floor.maps.frame = ""
    assert floor.robots.transform_to_map("odom") is None


def test_locked_marker_moves_with_its_frame(floor):
    floor.tf.places = {"map": 0.0, "ada/base": 5.0}
    floor.maps.frame = "map"
    floor.hear("/mark", dot("ada/base", frame_locked=True))
    assert floor.points("/mark") == [[[6.0, 0.0]]]
    floor.tf.places["ada/base"] = 7.0
    assert floor.look(now=overlays.AGAIN_S / 2) == {}
    assert floor.points("/mark", now=overlays.AGAIN_S) == [[[8.0, 0.0]]]


def test_what_ends_is_removed(floor):
    """A scan that is silent, a lifetime, a deletion, a node, and the view of another tab."""
    floor.robots.frames["ada"] = "odom"
    floor.hear("/lidar", scan("odom"), now=0.0)
    floor.hear("/mark", dot())
    passing = dot(number=1)
    passing.lifetime.secs = 3
    floor.hear("/marks", MarkerArray([dot(), passing]), now=0.0)
    shown = floor.look(now=1.9)
    assert (len(shown["/lidar"]), len(shown["/marks"])) == (1, 2)
    assert floor.look(now=2.0) == {"/lidar": []}
    assert len(floor.look(now=3.0)["/marks"]) == 1
    floor.hear("/marks", MarkerArray([dot(action=Marker.DELETEALL)]), now=3.0)
    assert floor.look(now=3.1) == {"/marks": []}
    floor.graphs.graph = Graph()
    assert floor.look(now=3.2)["/mark"] == []
    assert not floor.tf.is_needed


def test_scan_without_tf_is_at_its_robot(floor):
    """As of a robot without a description."""
    floor.robots.frames["ada"] = "odom"
    floor.hear("/ada/scan", scan("camera"))
    [shape] = floor.look()["/ada/scan"]
    assert (shape["robot"], shape["points"]) == ("ada", [[1.0, 0.0]])
    floor.tf.places = {"odom": 0.0, "camera": 5.0}
    [shape] = floor.look(now=overlays.AGAIN_S)["/ada/scan"]
    assert ("robot" in shape, shape["points"]) == (False, [[6.0, 0.0]])


@claim("What hostile nodes ...", because="their messages wait, and are read in turn")
def test_flood_of_markers_is_read_within_a_budget(floor):
    floor.maps.frame = "odom"
    large = dot()
    large.points *= 2000
    for _ in range(overlays.MOST_WAITING + 10):
        floor.hear("/mark", large)
    floor.hear("/mark", b"malformed")
    floor.hear("/marks", MarkerArray([dot()]))
    floor.hear("/ada/plan", path("odom", 0.0, 1.0))
    floor.hear("/lidar", LaserScan(ranges=[1.0] * overlays.LONGEST))
    waiting = lambda topic: len(floor.source._layers[topic].waiting)  # noqa: E731
    assert (waiting("/mark"), waiting("/lidar")) == (overlays.MOST_WAITING, 0)
    shown = set()
    for beat in range(20):
        shown |= set(floor.look(now=beat * 0.05))
    assert shown >= {"/marks", "/mark", "/ada/plan"}
    assert waiting("/mark") > overlays.MOST_WAITING / 2


def test_topics_points_and_frames_are_bounded():
    names = {f"/marks_{n}": MarkerArray._type for n in range(100)}
    floor = Floor(names)
    assert len(floor.handlers) == overlays.MOST_TOPICS
    long = [dot("map", n, scale=Vector3(1, 1, 1)) for n in range(100)]
    for message in long:
        message.points *= 200
    floor.hear("/marks_0", MarkerArray(long[:50]))
    assert len(floor.look()["/marks_0"]) == overlays.MOST_POINTS / 200
    for n in range(overlays.MOST_PAGES + 5):
        floor.maps.frame = f"map_{n}"
        floor.tf.places = {"map": 0.0, floor.maps.frame: 0.0}
        floor.look(now=n)
    layer = floor.source._layers["/marks_0"]
    assert len(layer.texts) <= overlays.MOST_PAGES
    assert all(len(shape.placed) <= overlays.MOST_PAGES for shape in layer.shapes.values())
