"""A world as messages: a map, and markers of walls, posts, cliffs and pressed bumpers."""

from __future__ import annotations

from math import cos, hypot, sin
from typing import Any

from geometry_msgs.msg import Point, Quaternion
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from fake_turtlebot_sim.simulator.occupancy import occupancy
from fake_turtlebot_sim.simulator.sensors import CENTER_RAD, SIDE_RAD, Three
from fake_turtlebot_sim.simulator.world import BASE_RADIUS_M, World

WALL_M = 0.3  # how high walls and posts are drawn
LINE_M = 0.02
GREY, RED = ColorRGBA(0.45, 0.42, 0.38, 1.0), ColorRGBA(0.85, 0.1, 0.1, 1.0)
BUMPERS = ((SIDE_RAD, CENTER_RAD), (CENTER_RAD, -CENTER_RAD), (-CENTER_RAD, -SIDE_RAD))
BUMPER_M = 0.05  # above the ground


def world_map(world: World, frame: str, stamp: Any) -> OccupancyGrid:
    """Return the OccupancyGrid of a world, in the frame."""
    cells, (x, y), resolution = occupancy(world)
    grid = OccupancyGrid()
    grid.header.frame_id, grid.header.stamp = frame, stamp
    grid.info.map_load_time = stamp
    grid.info.resolution = resolution
    grid.info.height, grid.info.width = cells.shape
    grid.info.origin.position.x, grid.info.origin.position.y = x, y
    grid.info.origin.orientation.w = 1.0
    grid.data = cells.ravel().tolist()
    return grid


def marker(ns: str, number: int, kind: int, frame: str, colour: ColorRGBA) -> Marker:
    """Return a Marker that stays where it is in the frame."""
    made = Marker(ns=ns, id=number, type=kind, action=Marker.ADD, color=colour)
    made.header.frame_id, made.frame_locked = frame, True
    made.pose.orientation = Quaternion(0.0, 0.0, 0.0, 1.0)
    made.scale.x = LINE_M
    return made


def world_markers(world: World, frame: str) -> list[Marker]:
    """Return walls (triangles, upright), posts (cylinders) and cliffs (lines)."""
    found = []
    if world.segments:
        walls = marker("walls", 0, Marker.TRIANGLE_LIST, frame, GREY)
        walls.scale.x = walls.scale.y = walls.scale.z = 1.0
        for x1, y1, x2, y2 in world.segments:
            walls.points += wall_side(x1, y1, x2, y2) + wall_side(x2, y2, x1, y1)
        found.append(walls)
    for number, (x, y, radius) in enumerate(world.posts):
        post = marker("posts", number, Marker.CYLINDER, frame, GREY)
        post.pose.position = Point(x, y, 0.5 * WALL_M)
        post.scale.x = post.scale.y = 2 * radius
        post.scale.z = WALL_M
        found.append(post)
    for number, cliff in enumerate(world.cliffs):
        edge = marker("cliffs", number, Marker.LINE_STRIP, frame, RED)
        edge.points = [Point(x, y, 0.0) for x, y in (*cliff, cliff[0])]
        found.append(edge)
    return found


def wall_side(x1: float, y1: float, x2: float, y2: float) -> list[Point]:
    """Return the two triangles of a wall's right side, a little off its middle."""
    off = 0.5 * LINE_M / max(hypot(x2 - x1, y2 - y1), 1e-9)
    dx, dy = off * (y2 - y1), off * (x1 - x2)
    a, b = Point(x1 + dx, y1 + dy, 0.0), Point(x2 + dx, y2 + dy, 0.0)
    c, d = Point(x2 + dx, y2 + dy, WALL_M), Point(x1 + dx, y1 + dy, WALL_M)
    return [a, b, c, a, c, d]


def bumper_markers(pressed: Three, frame: str) -> list[Marker]:
    """Return a red arc for each pressed bumper, left, center and right; none for the others."""
    found = []
    for number, (is_pressed, (begin, end)) in enumerate(zip(pressed, BUMPERS)):
        arc = marker("bumpers", number, Marker.LINE_STRIP, frame, RED)
        arc.action = Marker.ADD if is_pressed else Marker.DELETE
        arc.scale.x = 2 * LINE_M
        for k in range(9):
            angle = begin + (end - begin) * k / 8
            x, y = BASE_RADIUS_M * cos(angle), BASE_RADIUS_M * sin(angle)
            arc.points.append(Point(x, y, BUMPER_M))
        found.append(arc)
    return found
