"""What nodes show on the floor, and the poses that a driver chooses there."""

import re
import sys
from contextlib import contextmanager
from math import cos, pi, sin

import pytest
import yaml
from geometry_msgs.msg import Point, PoseStamped, TransformStamped, Vector3
from nav_msgs.msg import Path
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys as Key
from sensor_msgs.msg import LaserScan
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.accessibility import violations
from tutorial_testing.cockpit.floor import drawn, settled
from tutorial_testing.cockpit.world import World
from tutorial_testing.waiting import wait_for

PHONE = (360, 740)
GREEN = "--good"  # of paths and goals
# Kind of marker -> its colour, place [m], and points.
LINE = [Point(-0.2, 0.1, 0), Point(0.2, 0.1, 0), Point(0.2, -0.1, 0), Point(-0.2, -0.1, 0)]
MARKERS = {
    Marker.CUBE: ("#ff0000", (0.6, 1.0), []),
    Marker.SPHERE: ("#0000ff", (1.6, 1.0), []),
    Marker.CYLINDER: ("#ff00ff", (0.6, 1.8), []),
    Marker.ARROW: ("#00ffff", (1.4, 1.8), []),
    Marker.LINE_STRIP: ("#ff8000", (0.6, -1.0), LINE),
    Marker.LINE_LIST: ("#80ff00", (1.6, -1.0), LINE),
    Marker.POINTS: ("#8000ff", (2.6, -1.0), LINE),
    Marker.SPHERE_LIST: ("#ff0080", (0.6, -1.8), LINE),
    Marker.TEXT_VIEW_FACING: ("#00ff80", (1.6, -1.8), []),
}
READER = """
import rospy
from geometry_msgs.msg import {kind}
rospy.init_node("reader")
rospy.Subscriber("{topic}", {kind}, lambda message: print(message, "\\n---", flush=True))
print("ready", flush=True)
rospy.spin()
"""


class Bare(World):
    """A master and a cockpit, without a robot; for viewers, too."""

    def __init__(self):
        super().__init__(lan=True)
        self.launch = ("--core", "-p", self.environment["ROS_MASTER_URI"].rpartition(":")[2])

    def observe(self, command, **environment):
        """There is no odometry."""


class Room(World):
    """A robot in a room; its Moments are true."""

    def observe(self, command, **environment):
        super().observe((*command, "odom:=base_pose_ground_truth"), **environment)


@pytest.fixture(scope="module")
def room():
    with Room("world:=room") as world:
        yield world


@pytest.fixture(scope="module")
def bare():
    with Bare() as world:
        yield world


@pytest.fixture
def floor(room, shared_browser):
    """The page with the room, of which nobody is the driver; its console has no errors."""
    shared_browser.errors()
    shared_browser.open(room.address)
    wait_for(lambda: settled(shared_browser, "--wall"), "walls")
    yield shared_browser
    assert shared_browser.errors() == []
    shared_browser.resize()


@contextmanager
def reading(world, page, topic, kind):
    """Yield a function that waits for the first message on a topic, and returns its fields."""

    def fields():
        wait_for(lambda: "---" in node.output, topic)
        return yaml.safe_load(node.output.partition("ready")[2].partition("---")[0])

    with world.run(sys.executable, "-c", READER.format(topic=topic, kind=kind)) as node:
        wait_for(lambda: "ready" in node.output, "reader")
        page.tab("Graph")
        page.wait_for_text("#graph-picture", "/reader")  # so that the cockpit knows it, too
        page.tab("Robot")
        yield fields


def publishing(world, topic, message):
    return world.run("rostopic", "pub", topic, message._type, str(message))


def marker(kind, **fields):
    """Return a Marker of this kind at its place."""
    colour, (x, y), points = MARKERS[kind]
    message = Marker(type=kind, id=kind, scale=Vector3(0.4, 0.4, 0.4), text="dock", **fields)
    message.points = points
    if points:
        message.scale = Vector3(0.08, 0.08, 0.08)
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    message.header.frame_id, message.color = "map", ColorRGBA(*parts, 1.0)
    message.pose.position = Point(x, y, 0)
    return message


@claim("Floor: markers of each simple kind and a path at their places, until they are deleted")
def test_markers_and_a_path_are_drawn_at_their_places(room, floor):
    path = Path(poses=[PoseStamped() for _ in range(2)])
    path.header.frame_id = "odom"
    path.poses[0].pose.position.x, path.poses[1].pose.position.x = 1.0, 2.0
    array = MarkerArray([marker(kind) for kind in MARKERS])
    with publishing(room, "/plan", path) as plan, publishing(room, "/markers", array):
        wait_for(lambda: drawn(floor, GREEN)[0] > 30, "path")
        shown = {}
        for kind, (colour, _, _) in MARKERS.items():
            shown[kind] = wait_for(lambda c=colour: settled(floor, c), f"marker {kind}")
        _, *way = drawn(floor, GREEN)
        plan.interrupt()
        wait_for(lambda: drawn(floor, GREEN)[0] == 0, "end of the path's publisher")
    _, left, middle = shown[Marker.CUBE]
    metre = shown[Marker.SPHERE][1] - left  # the two are as far apart
    assert metre > 30
    for kind, (_, (x, y), _) in MARKERS.items():
        count, at_x, at_y = shown[kind]
        assert count > 10, kind
        expected = (left + (x - 0.6) * metre, middle - (y - 1.0) * metre)
        assert (at_x, at_y) == pytest.approx(expected, abs=0.3 * metre), kind
    assert way == pytest.approx([left + 0.9 * metre, middle + metre], abs=3)
    with publishing(room, "/markers", MarkerArray([marker(Marker.CUBE)])):
        wait_for(lambda: drawn(floor, "#ff0000")[0], "marker")
        with publishing(room, "/markers", MarkerArray([marker(0, action=Marker.DELETEALL)])):
            wait_for(lambda: not drawn(floor, "#ff0000")[0], "its deletion")


@claim("A scan is drawn where tf has its frame, also without a map, odometry and a robot")
def test_scan_of_a_scanner_alone(bare, shared_browser):
    mount = TransformStamped(child_frame_id="laser")
    mount.header.frame_id = "odom"
    mount.transform.translation.x = 1.0
    mount.transform.rotation.z, mount.transform.rotation.w = sin(pi / 4), cos(pi / 4)
    scan = LaserScan(ranges=[1.0], range_max=9.0)
    scan.header.frame_id = "laser"
    shared_browser.open(bare.address)
    with publishing(bare, "/tf_static", TFMessage([mount])):
        with bare.run("rostopic", "pub", "-r", "5", "/scan", scan._type, str(scan)):
            wait_for(lambda: drawn(shared_browser, "--scan")[0], "scan")
            box, top = shared_browser.one("#floor").rect, shared_browser.one(".toolbar").rect
            left, bottom = box["x"] + box["width"] / 2, box["y"] + box["height"]
            middle = (top["y"] + top["height"] + bottom) / 2
            place = pytest.approx([left + 110, middle - 110], abs=3)  # a metre each
            wait_for(lambda: drawn(shared_browser, "--scan")[1:] == place, "scan at its place")
        wait_for(lambda: not drawn(shared_browser, "--scan")[0], "end of the scan")


@claim("A driver sets a goal by two actions: its button and a drag; viewers have no such button")
def test_goal_by_a_drag(room, bare, floor):
    def drag(*keys):
        actions = ActionChains(floor.driver).move_to_element(floor.one("#floor"))
        actions.click_and_hold().move_by_offset(0, -80).send_keys(*keys).release().perform()

    floor.click("Set goal")
    drag(Key.ESCAPE)
    assert floor.one("#set-goal").get_attribute("aria-pressed") == "false"
    assert (floor.text("#tool"), drawn(floor, GREEN)[0]) == ("", 0)
    with room.run("rostopic", "echo", "-n1", "/move_base_simple/goal") as echo:
        wait_for(lambda: "does not appear to be published yet" in echo.output, "echo")
        floor.click("Set goal")
        drag()
        wait_for(lambda: "frame_id" in echo.output, "first goal")
        echo.wait()
    floor.click("Set goal")
    drag()
    floor.wait_for_text("#notice", "Nothing subscribes to /move_base_simple/goal")
    with reading(room, floor, "move_base_simple/goal", "PoseStamped") as message:
        floor.click("Set goal")
        drag()
        goal = message()
    turn = goal["pose"]["orientation"]
    assert goal["header"]["frame_id"] == "map"
    assert (turn["z"], turn["w"]) == pytest.approx((sin(pi / 4), cos(pi / 4)), abs=0.01)
    assert drawn(floor, GREEN)[0] > 100  # The goal stays.
    floor.open(f"http://127.0.0.1:{bare.port}/?token={bare.token('look')}")
    names = {button.accessible_name for button in floor.all("#robot button")}
    assert "Zoom in" in names and not names & {"Set goal", "Set pose"}


@claim("A pose is set by keys alone, and announced; axe finds nothing there on a phone")
def test_pose_by_keys(room, floor):
    with reading(room, floor, "initialpose", "PoseWithCovarianceStamped") as message:
        floor.resize(*PHONE)
        floor.one("#set-pose").send_keys(Key.SPACE)
        assert floor.ask("document.activeElement.id") == "floor"
        floor.wait_for_text("#tool", "Esc cancels")
        assert violations(floor) == []
        assert floor.ask("document.documentElement.scrollWidth") <= PHONE[0]
        floor.one("#floor").send_keys(Key.ARROW_LEFT, Key.ARROW_UP, *"[" * 6, "]")
        said = floor.text("#tool")
        x, y, degrees = map(float, re.fullmatch(r"Pose: (.+), (.+) m, (.+)°\. ", said).groups())
        assert (x < 1.0, y > 0.0, degrees) == (True, True, 75.0)
        floor.one("#floor").send_keys(Key.ENTER)
        variances = message()["pose"]["covariance"]
    floor.wait_for_text("#tool", "Published.")
    assert {i: value for i, value in enumerate(variances) if value} == pytest.approx(
        {0: 0.25, 7: 0.25, 35: 0.0685}, abs=1e-3
    )
    expected = pytest.approx((x, y, 75 * pi / 180), abs=0.01)
    wait_for(lambda: room.now.pose == expected, "robot there")
    assert floor.ask("document.activeElement.id") == "set-pose"
