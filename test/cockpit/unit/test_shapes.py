"""Scans, paths and markers as shapes on the floor."""

from math import cos, inf, nan, pi, sin

import genpy
import pytest
from geometry_msgs.msg import Point, PoseStamped, Quaternion, Transform, Vector3
from nav_msgs.msg import Path
from sensor_msgs.msg import LaserScan
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from cockpit_server.tabs import shapes
from tutorial_testing.claims import claim

HALF = sin(pi / 4)
LEFT = Quaternion(0.0, 0.0, HALF, HALF)  # turned by 90 degrees
POINTS = [Point(0.0, 0.0, 5.0), Point(1.0, 0.0, 0.0), Point(1.0, 2.0, 0.0), Point(3.0, 2.0, 0.0)]


def marker(kind=Marker.CUBE, number=0, scale=(2.0, 1.0, 0.5), **fields):
    message = Marker(type=kind, id=number, scale=Vector3(*scale), **fields)
    message.color = ColorRGBA(1.0, 0.5, 0.0, 1.0)
    message.pose.position.x = 10.0
    return message


def scan(ranges, **fields):
    limits = {"angle_min": -pi / 3, "angle_increment": pi / 6, "range_min": 0.4, "range_max": 9.0}
    return LaserScan(ranges=ranges, **{**limits, **fields})


def shapes_of(*messages, now=0.0):
    so_far = {}
    for message in messages:
        shapes.update(so_far, message, now)
    return so_far


def on_floor(message, x=0.0, turn=None):
    """Return the points on the floor of a message with one shape."""
    [shape] = shapes_of(message).values()
    shape.place("map", Transform(Vector3(x, 0.0, 9.0), turn or Quaternion()))
    return shape.placed["map"]


def corners(points):
    return {(round(x, 2) + 0.0, round(y, 2) + 0.0) for x, y in points}


CUBE = {(9.0, -0.5), (11.0, -0.5), (11.0, 0.5), (9.0, 0.5)}


@claim("Markers of RViz are drawn on the floor as they are seen from above")
@pytest.mark.parametrize(
    ("message", "expected"),
    [
        (marker(), CUBE),
        (marker(Marker.LINE_STRIP, points=POINTS), {(10, 0), (11, 0), (11, 2), (13, 2)}),
        (marker(Marker.LINE_LIST, points=POINTS[:3]), {(10, 0), (11, 0)}),  # a half pair
        (marker(Marker.POINTS, points=POINTS[:1]), {(10, 0)}),
        (marker(Marker.CUBE_LIST, points=POINTS[:1]), {(10, 0)}),
        (marker(Marker.SPHERE_LIST, points=POINTS[:1]), {(10, 0)}),
        (marker(Marker.TEXT_VIEW_FACING, text="dock"), {(10, 0)}),
        (marker(Marker.ARROW), {(10, -0.2), (11.4, -0.2), (11.4, -0.5), (12, 0), (11.4, 0.5),
                                (11.4, 0.2), (10, 0.2)}),
    ],
)  # fmt: skip
def test_marker_as_seen_from_above(message, expected):
    assert corners(on_floor(message)) == expected


def test_marker_is_turned_by_its_pose_and_its_frame():
    message = marker()
    message.pose.orientation = LEFT
    assert corners(on_floor(message)) == {(9.5, -1), (10.5, -1), (10.5, 1), (9.5, 1)}
    twice = corners(on_floor(message, x=1.0, turn=LEFT))
    assert twice == {(0, 9.5), (2, 9.5), (2, 10.5), (0, 10.5)}
    message.pose.orientation = Quaternion(0.0, 2 * HALF, 0.0, 2 * HALF)  # upright, of length 2
    assert corners(on_floor(message)) == {(9.75, -0.5), (10.25, -0.5), (10.25, 0.5), (9.75, 0.5)}


@pytest.mark.parametrize("kind", [Marker.SPHERE, Marker.CYLINDER])
def test_round_marker_is_as_wide_as_its_scale(kind):
    points = on_floor(marker(kind))
    assert max(x for x, _ in points) == pytest.approx(11.0, abs=0.01)
    assert min(y for _, y in points) == pytest.approx(-0.5, abs=0.01)
    assert len(points) >= 12


def test_arrow_between_two_points():
    message = marker(Marker.ARROW, scale=(0.1, 0.4, 0.0), points=[Point(0, 0, 0), Point(0, 2, 0)])
    points = corners(on_floor(message))
    assert {(10.0, 2.0), (10.2, 1.4), (9.8, 1.4)} <= points  # the tip, and 0.4 m across
    upward = marker(Marker.ARROW, points=[Point(0, 0, 0), Point(0, 0, 2)])
    assert corners(on_floor(upward)) == {(10.0, 0.0)}


def test_style_of_a_marker():
    [shape] = shapes_of(marker(Marker.LINE_STRIP, points=POINTS)).values()
    assert (shape.style["colour"], shape.style["size"]) == ("#ff8000ff", 2.0)
    [text] = shapes_of(marker(Marker.TEXT_VIEW_FACING, text="x" * 500)).values()
    assert (text.style["text"], text.style["size"]) == ("x" * 200, 0.5)
    several = marker(Marker.POINTS, points=POINTS[:1], colors=[ColorRGBA(0, 0, 1, 0.2)])
    assert shapes_of(several)[("", 0)].style["colour"] == "#0000ff33"


@claim("Markers are added, replaced and deleted as in RViz")
def test_actions_of_markers():
    first, second = marker(ns="a"), marker(ns="a", number=1, lifetime=genpy.Duration(3))
    so_far = shapes_of(MarkerArray([first, second]), now=100.0)
    assert [shape.until for shape in so_far.values()] == [inf, 103.0]
    shapes.update(so_far, marker(Marker.SPHERE, ns="a", frame_locked=True), 100.0)
    assert list(so_far) == [("a", 1), ("a", 0)] and so_far["a", 0].is_locked
    shapes.update(so_far, marker(number=1, action=Marker.DELETE), 100.0)  # of another namespace
    assert len(so_far) == 2
    shapes.update(so_far, marker(ns="a", number=1, action=Marker.DELETE), 100.0)
    assert list(so_far) == [("a", 0)]
    shapes.update(so_far, marker(action=Marker.DELETEALL), 100.0)
    assert so_far == {}
    assert shapes_of(marker(Marker.MESH_RESOURCE), marker(Marker.TRIANGLE_LIST)) == {}


@claim("What hostile nodes publish for the floor is bounded, and no number is infinite")
def test_shapes_are_bounded_and_finite():
    many = MarkerArray([marker(number=n) for n in range(shapes.MOST_SHAPES + 5)])
    assert list(shapes_of(many)) == [("", n) for n in range(5, shapes.MOST_SHAPES + 5)]
    long = marker(Marker.LINE_LIST, points=POINTS * 5000)
    assert 0 < len(on_floor(long)) <= 2 * shapes.MOST_POINTS
    wrong = marker(Marker.POINTS, scale=(nan, 0, 0), points=[Point(nan, 0, 0), Point(1e9, 0, 0)])
    wrong.color = ColorRGBA(nan, inf, -inf, 7.0)
    assert on_floor(wrong) == []
    [shape] = shapes_of(wrong).values()
    assert shape.style == {"colour": "#00ff00ff", "size": 0.0, "text": ""}
    assert on_floor(marker(scale=(inf, 1.0, 1.0))) == []


def test_path_as_a_line():
    path = Path(poses=[PoseStamped() for _ in POINTS])
    for stamped, point in zip(path.poses, POINTS):
        stamped.pose.position = point
    assert on_floor(path) == [[0, 0], [1, 0], [1, 2], [3, 2]]
    assert list(shapes_of(path, Path(), path)) == [0]
    assert on_floor(Path()) == []


def test_scan_as_points():
    message = scan([1.0, 0.2, 20.0, -inf, 2.0])
    first, last = on_floor(message, x=0.1)
    assert first == pytest.approx([0.1 + cos(pi / 3), -sin(pi / 3)], abs=1e-3)
    assert last == pytest.approx([1.1, 2 * sin(pi / 3)], abs=1e-3)
    [shape] = shapes_of(message, now=5.0).values()
    assert shape.until == 5.0 + shapes.OLD_S
    assert len(on_floor(scan([1.0] * 10_000))) <= shapes.MOST_BEAMS
    assert on_floor(scan([1.0], angle_min=nan)) == []
