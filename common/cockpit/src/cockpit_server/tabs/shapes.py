"""What other programs show on the floor, as shapes: scans, paths and the markers of RViz."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from math import cos, inf, pi, sin
from typing import Any, Dict, Hashable, Iterable

import numpy as np
from geometry_msgs.msg import Transform
from nav_msgs.msg import Path
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

from cockpit_server.limits import MOST_PAGES
from cockpit_server.tabs.motion import FARTHEST_M

MOST_SHAPES, MOST_POINTS = 300, 1000  # of a topic, in a shape; a longer one is thinned out
MOST_BEAMS, OLD_S = 160, 2.0  # of a scan; the slowest scanners publish 5 scans a second
LONGEST_TEXT, DIGITS = 200, 3  # characters; after the point [m]


def turned(*profile: tuple[float, float]) -> Any:
    """Return the points of a solid of revolution. profile: (radius, height) of its edge."""
    angles = np.arange(0.0, 2 * pi, pi / 8)
    return np.array([(r * cos(angle), r * sin(angle), z) for r, z in profile for angle in angles])


# A marker's type -> how it is drawn, and its points at the scale 1; None: it has points itself.
ARROW = np.array([
    (0.0, -0.2, 0), (0.7, -0.2, 0), (0.7, -0.5, 0), (1, 0, 0), (0.7, 0.5, 0), (0.7, 0.2, 0),
    (0.0, 0.2, 0),
])  # fmt: skip
MARKERS = {
    Marker.ARROW: ("area", ARROW),
    Marker.CUBE: ("solid", np.array(list(product((-0.5, 0.5), repeat=3)))),
    Marker.SPHERE: ("solid", turned(*((cos(a) / 2, sin(a) / 2) for a in np.arange(-1.5, 2, 0.25)))),
    Marker.CYLINDER: ("solid", turned((0.5, -0.5), (0.5, 0.5))),
    Marker.TEXT_VIEW_FACING: ("text", np.zeros((1, 3))),
    Marker.LINE_STRIP: ("line", None),
    Marker.LINE_LIST: ("pairs", None),
    Marker.POINTS: ("dots", None),
    Marker.CUBE_LIST: ("dots", None),
    Marker.SPHERE_LIST: ("dots", None),
}
AROUND = turned((1.0, 0.0))[:, :2].T  # directions on the floor


@dataclass(eq=False)
class Shape:
    """points (n, 3) [m] in a frame at a time, and how pages draw them.

    kind: line; pairs, a line from each first to each second point; area, between its corners;
    solid, whose outline on the floor is an area; dots; text. style: colour (of CSS, or the name of
    a variable), size [m], text. until: [s]. is_locked: it moves with its frame.
    """

    kind: str
    points: Any
    header: Any
    style: dict[str, Any]
    until: float = inf
    is_locked: bool = False
    placed: dict[str, list[list[float]]] = field(default_factory=dict)  # by frame of the floor

    @property
    def frame(self) -> str:
        return str(self.header.frame_id).lstrip("/")

    def place(self, frame: str, transform: Transform) -> None:
        """Note the points on the floor. transform: of points in the shape's frame to it."""
        if len(self.placed) >= MOST_PAGES:
            self.placed.clear()
        points = moved(self.points, transform.translation, transform.rotation)[:, :2]
        points = points[(np.abs(points) < FARTHEST_M).all(axis=1)]  # NaN is not less.
        if self.kind == "solid" and len(points):
            farthest = np.argmax(points @ AROUND, axis=0)
            points = points[list(dict.fromkeys(farthest))]
        self.placed[frame] = points.round(DIGITS).tolist()


Shapes = Dict[Hashable, Shape]


def update(shapes: Shapes, message: Any, now: float) -> None:
    """Change a topic's shapes as a new message says. now: its arrival [s]."""
    if isinstance(message, LaserScan):
        style = {"colour": "--scan", "size": 0}
        shapes[0] = Shape("dots", scan_points(message), message.header, style, now + OLD_S)
    elif isinstance(message, Path):
        points = array(pose.pose.position for pose in message.poses)
        style = {"colour": "--good", "size": 0}
        shapes[0] = Shape("line", thinned(points, MOST_POINTS), message.header, style)
    else:
        for marker in message.markers if isinstance(message, MarkerArray) else [message]:
            update_marker(shapes, marker, now)


def update_marker(shapes: Shapes, marker: Marker, now: float) -> None:
    key = marker.ns[:LONGEST_TEXT], marker.id
    if marker.action == Marker.DELETEALL:
        shapes.clear()
    elif marker.action == Marker.DELETE:
        shapes.pop(key, None)
    elif marker.type in MARKERS:
        shapes.pop(key, None)
        shapes[key] = marker_shape(marker, now)
        if len(shapes) > MOST_SHAPES:
            del shapes[next(iter(shapes))]


def marker_shape(marker: Marker, now: float) -> Shape:
    kind, points = MARKERS[marker.type]
    size = np.array([marker.scale.x, marker.scale.y, marker.scale.z])
    given = array(marker.points)
    if points is None:
        points = given[: len(given) // 2 * 2].reshape(-1, 2, 3) if kind == "pairs" else given
        points = thinned(points, MOST_POINTS).reshape(-1, 3)
    elif marker.type == Marker.ARROW and len(given) == 2:
        points = arrow(given[0], given[1], size[1])
    else:
        points = points * size
    width = {"area": 0.0, "solid": 0.0, "text": size[2]}.get(kind, size[0])
    style = {
        "colour": colour(marker.colors[0] if marker.colors else marker.color),
        "size": float(np.nan_to_num(np.clip(width, 0, FARTHEST_M))),
        "text": marker.text[:LONGEST_TEXT],
    }
    lifetime_s = marker.lifetime.to_sec()
    until = now + lifetime_s if lifetime_s > 0 else inf
    points = moved(points, marker.pose.position, marker.pose.orientation)
    return Shape(kind, points, marker.header, style, until, bool(marker.frame_locked))


def array(points: Iterable[Any]) -> Any:
    return np.array([(p.x, p.y, p.z) for p in points]).reshape(-1, 3)


def thinned(points: Any, most: int) -> Any:
    return points[:: len(points) // most + 1]


def arrow(start: Any, end: Any, width: float) -> Any:
    ahead = end - start
    aside = np.array([-ahead[1], ahead[0], 0.0]) * width / (np.hypot(ahead[0], ahead[1]) or 1.0)
    return start + ARROW[:, :1] * ahead + ARROW[:, 1:2] * aside


@np.errstate(all="ignore")  # NumPy warns of numbers that are not finite; place() drops them.
def moved(points: Any, place: Any, turn: Any) -> Any:
    """Return points, turned by a quaternion of any length and then moved; 0: not turned."""
    x, y, z, w = turn.x, turn.y, turn.z, turn.w
    f = 2.0 / (x * x + y * y + z * z + w * w or inf)
    rows = (
        (1 - f * (y * y + z * z), f * (x * y + z * w), f * (x * z - y * w)),
        (f * (x * y - z * w), 1 - f * (x * x + z * z), f * (y * z + x * w)),
        (f * (x * z + y * w), f * (y * z - x * w), 1 - f * (x * x + y * y)),
    )
    return points @ np.array(rows) + (place.x, place.y, place.z)


def colour(rgba: Any) -> str:
    """Return a colour for CSS."""
    parts = np.nan_to_num(np.clip([rgba.r, rgba.g, rgba.b, rgba.a], 0, 1)) * 255
    return f"#{parts.round().astype(np.uint8).tobytes().hex()}"


def scan_points(scan: LaserScan) -> Any:
    """Return the end points of a scan's beams (n, 3) [m] in the scanner's frame."""
    ranges = np.array(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    is_seen = np.isfinite(ranges + angles) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
    ranges, angles = ranges[is_seen], angles[is_seen]
    ends = np.stack((ranges * np.cos(angles), ranges * np.sin(angles), 0.0 * ranges), axis=1)
    return thinned(ends, MOST_BEAMS)
