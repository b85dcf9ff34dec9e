"""A world as messages: a map, and markers for walls, posts, cliffs and pressed bumpers."""

from __future__ import annotations

from array import array
from math import ceil, cos, hypot, sin
from typing import Any

import numpy as np
from geometry_msgs.msg import Point, Quaternion, Vector3
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from fake_turtlebot_sim.simulator.grid_map import OCCUPIED, UNKNOWN, Grid
from fake_turtlebot_sim.simulator.sensors import CENTER_RAD, SIDE_RAD, Three
from fake_turtlebot_sim.simulator.world import BASE_RADIUS_M, World, gaps, is_inside

MARGIN_M = 0.5  # free cells around all obstacles
MOST_CELLS = 4_000_000
MOST_WALLS = 20_000  # as markers; more would be several MB each second
WALL_M, LINE_M = 0.3, 0.02  # the height of walls and posts, and the width of lines
BUMPER_M = 0.05  # above the ground
GREY, RED = ColorRGBA(0.45, 0.42, 0.38, 1.0), ColorRGBA(0.85, 0.1, 0.1, 1.0)


def world_map(world: World, frame: str, stamp: Any, resolution: float = 0.05) -> OccupancyGrid:
    """Return the OccupancyGrid of a world: that of its map, or cells drawn from its obstacles."""
    return grid_message(world.grid or _drawn(world, resolution), frame, stamp)


def grid_message(grid: Grid, frame: str, stamp: Any) -> OccupancyGrid:
    """Return the OccupancyGrid of a Grid that was loaded at `stamp`."""
    x, y, yaw = grid.origin
    message = OccupancyGrid(data=array("b", grid.cells.tobytes()))
    message.header.frame_id, message.header.stamp = frame, stamp
    info = message.info
    info.map_load_time, info.resolution = stamp, grid.resolution
    info.height, info.width = grid.cells.shape
    info.origin.position = Point(x, y, 0.0)
    info.origin.orientation = Quaternion(0.0, 0.0, sin(0.5 * yaw), cos(0.5 * yaw))
    return message


def _drawn(world: World, resolution: float) -> Grid:
    """Return a world as cells.

    A cell is occupied if its centre is within half a cell of a wall, a post or an edge, and unknown
    if it is over a cliff. If the world needs more than MOST_CELLS, the cells are larger than the
    resolution [m].
    """
    obstacles = (*world.obstacles, *world.edges)
    table = np.array(obstacles or [(0.0,) * 5])
    ends, radii = table[:, :4].reshape(-1, 2, 2), table[:, 4:]
    low = (ends.min(axis=1) - radii).min(axis=0) - MARGIN_M
    size = (ends.max(axis=1) + radii).max(axis=0) + MARGIN_M - low
    resolution = max(resolution, float(np.sqrt(size.prod() / MOST_CELLS)))
    half = 0.5 * resolution + 1e-6
    xs, ys = (
        at + (np.arange(ceil(length / resolution)) + 0.5) * resolution
        for at, length in zip(low, size)
    )
    cells = np.zeros((len(ys), len(xs)), dtype=np.int8)
    for cliff in world.cliffs:
        cells[is_inside(xs, ys[:, None], cliff)] = UNKNOWN
    for obstacle in obstacles:
        x1, y1, x2, y2, radius = obstacle
        reach = radius + half
        columns = slice(*np.searchsorted(xs, (min(x1, x2) - reach, max(x1, x2) + reach)))
        rows = slice(*np.searchsorted(ys, (min(y1, y2) - reach, max(y1, y2) + reach)))
        is_near = gaps(xs[columns], ys[rows, None], obstacle) <= half
        cells[rows, columns][is_near] = OCCUPIED
    return Grid(cells, resolution, (float(low[0]), float(low[1]), 0.0))


def marker(ns: str, number: int, kind: int, frame: str, colour: ColorRGBA) -> Marker:
    """Return a Marker that is fixed in the frame: without a stamp, and locked to it."""
    made = Marker(ns=ns, id=number, type=kind, action=Marker.ADD, color=colour)
    made.header.frame_id, made.frame_locked = frame, True
    made.pose.orientation = Quaternion(0.0, 0.0, 0.0, 1.0)
    made.scale.x = LINE_M
    return made


def world_markers(world: World, frame: str) -> list[Marker]:
    """Return walls (upright triangles), posts (cylinders) and cliffs (lines)."""
    markers = []
    if 0 < len(world.segments) <= MOST_WALLS:
        walls = marker("walls", 0, Marker.TRIANGLE_LIST, frame, GREY)
        walls.scale = Vector3(1.0, 1.0, 1.0)
        for x1, y1, x2, y2, _ in world.segments:
            walls.points += wall_side(x1, y1, x2, y2) + wall_side(x2, y2, x1, y1)
        markers.append(walls)
    for number, (x, y, radius) in enumerate(world.posts):
        post = marker("posts", number, Marker.CYLINDER, frame, GREY)
        post.pose.position = Point(x, y, 0.5 * WALL_M)
        post.scale = Vector3(2 * radius, 2 * radius, WALL_M)
        markers.append(post)
    for number, cliff in enumerate(world.cliffs):
        edge = marker("cliffs", number, Marker.LINE_STRIP, frame, RED)
        edge.points = [Point(x, y, 0.0) for x, y in (*cliff, cliff[0])]
        markers.append(edge)
    return markers


def wall_side(x1: float, y1: float, x2: float, y2: float) -> list[Point]:
    """Return the two triangles of a wall's right side, slightly off its centre line."""
    off = 0.5 * LINE_M / max(hypot(x2 - x1, y2 - y1), 1e-9)
    dx, dy = off * (y2 - y1), off * (x1 - x2)
    a, b = Point(x1 + dx, y1 + dy, 0.0), Point(x2 + dx, y2 + dy, 0.0)
    c, d = Point(x2 + dx, y2 + dy, WALL_M), Point(x1 + dx, y1 + dy, WALL_M)
    return [a, b, c, a, c, d]


def bumper_markers(pressed: Three, frame: str) -> list[Marker]:
    """Return a red arc for each pressed bumper, and a deletion for each of the others."""
    markers = []
    ends = (SIDE_RAD, CENTER_RAD, -CENTER_RAD, -SIDE_RAD)
    for number, (is_pressed, begin, end) in enumerate(zip(pressed, ends, ends[1:])):
        arc = marker("bumpers", number, Marker.LINE_STRIP, frame, RED)
        arc.action = Marker.ADD if is_pressed else Marker.DELETE
        arc.scale.x = 2 * LINE_M
        for angle in np.linspace(begin, end, 9).tolist():
            x, y = BASE_RADIUS_M * cos(angle), BASE_RADIUS_M * sin(angle)
            arc.points.append(Point(x, y, BUMPER_M))
        markers.append(arc)
    return markers
