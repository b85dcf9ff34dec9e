"""The map and the scan, as pages get them."""

import base64
from math import cos, inf, nan, pi

import pytest
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from cockpit_server.graph import ODOMETRY, Graph
from cockpit_server.tabs import map_and_scan
from tutorial_testing.claims import claim
from tutorial_testing.session_room import Graphs, Topics, look, page, serialised

TYPES = {
    "/map": "nav_msgs/OccupancyGrid", "/tf_static": "tf2_msgs/TFMessage",
    "/ada/odom": ODOMETRY, "/ada/scan": "sensor_msgs/LaserScan",
}  # fmt: skip


def grid(rows, columns, data, cell=0.5):
    message = OccupancyGrid()
    message.info.height, message.info.width, message.info.resolution = rows, columns, cell
    message.info.origin.position.x, message.data = -1.0, data
    return message


def scan(ranges, **fields):
    limits = {"angle_min": -0.5, "angle_increment": 0.5, "range_min": 0.4, "range_max": 9.0}
    message = LaserScan(ranges=ranges, **{**limits, **fields})
    message.header.frame_id = "ada/camera"
    return message


class Seen(Topics):
    """The MapAndScan of the robot ada, and a page that shows her."""

    def __init__(self):
        super().__init__()
        published = {topic: {"/sim"} for topic in TYPES}
        self.graphs = Graphs(Graph(publishers=published, types=TYPES))
        self.source = map_and_scan.MapAndScan(self, self.graphs)
        self.page = page(floor=True, look="ada")
        self.look()

    def look(self, now=0.0):
        """Return the messages that the page is sent at a time [s], by kind."""
        return {message["kind"]: message for message in look(self.source, self.page, now=now)[0]}


@claim("Floor: map, scan ...", because="until the world ends")
def test_a_page_gets_the_map_and_the_scan_when_they_change():
    seen = Seen()
    assert seen.look() == {}  # no map, as on an empty plane
    mount = TransformStamped()
    mount.child_frame_id, mount.transform.translation.x = "ada/camera", -0.1
    seen.hear("/map", grid(1, 3, [0, 100, -1]))
    seen.hear("/tf_static", TFMessage([mount]))
    seen.hear("/ada/scan", scan([inf, 2.0, nan]))
    got = seen.look()
    assert base64.b64decode(got["map"]["cells"]) == b"\0\1\2"
    assert (got["scan"]["robot"], got["scan"]["points"]) == ("ada", [[1.9, 0.0]])
    assert seen.look() == {}
    others = (TransformStamped(child_frame_id=f"link_{n}") for n in range(map_and_scan.MOST_FRAMES))
    seen.hear("/tf_static", TFMessage([*others]))  # only that many are kept, the newest
    seen.hear("/ada/scan", scan([inf, 3.0, nan]), now=0.2)
    assert seen.look()["scan"]["points"] == [[3.0, 0.0]]
    seen.graphs.graph = Graph()
    gone = seen.look()  # they go with their last publishers
    assert (gone["map"], gone["scan"]["points"]) == ({"kind": "map"}, [])


def test_a_robot_without_a_map_has_a_scan_all_the_same():
    """A real TurtleBot has no map before gmapping is started."""
    seen = Seen()
    seen.hear("/ada/scan", scan([2.0, inf, nan]))
    assert len(seen.look()["scan"]["points"]) == 1
    assert seen.look(1.0) == {}
    assert seen.look(3.0)["scan"]["points"] == []  # as after its scanner was killed


@pytest.mark.parametrize(
    "message", [String("no map"), grid(2, 2, [0]), grid(0, 0, []), grid(1, 1, [0], cell=nan)]
)
def test_a_malformed_map_is_left_out(message):
    assert map_and_scan.map_shown(serialised(message)) == {}


def test_a_map_is_turned_as_its_origin_is():
    turned = grid(1, 1, [0])
    turned.info.origin.orientation.z = turned.info.origin.orientation.w = 0.5**0.5
    assert map_and_scan.map_shown(serialised(turned))["yaw"] == pytest.approx(pi / 2)


def test_a_large_map_gets_larger_cells_and_keeps_its_walls():
    data = [0] * (1001 * 1200)
    data[500 * 1200 + 600] = 100
    shown = map_and_scan.map_shown(serialised(grid(1001, 1200, data)))
    cells = base64.b64decode(shown["cells"])
    assert len(cells) == shown["rows"] * shown["columns"] <= map_and_scan.MOST_CELLS
    factor = shown["cell"] / 0.5
    at = cells.index(1)
    assert (at // shown["columns"], at % shown["columns"]) == (500 // factor, 600 // factor)
    assert cells.count(1) == 1


def test_a_scan_as_points_on_the_robot():
    message = scan([1.0, 0.2, 20.0, -inf, 2.0], angle_min=-pi / 3, angle_increment=pi / 6)
    first, last = map_and_scan.scan_points(serialised(message), {"ada/camera": (0.1, 0.0)})
    assert first == pytest.approx([0.1 + cos(pi / 3), -(3**0.5) / 2], abs=1e-3)
    assert last == pytest.approx([1.1, 3**0.5], abs=1e-3)
    points = map_and_scan.scan_points(serialised(scan([1.0] * 10_000)), {})
    assert len(points) <= map_and_scan.MOST_POINTS
    assert map_and_scan.scan_points(b"none", {}) == []
    assert map_and_scan.scan_points(serialised(scan([1.0], angle_min=nan)), {}) == []
