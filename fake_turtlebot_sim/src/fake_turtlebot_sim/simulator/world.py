"""A world of walls, posts and cliffs, and the part of it that is near a robot."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import hypot, nan, pi
from typing import Any, Iterable, Sequence, Tuple

import numpy as np

from fake_turtlebot_sim.simulator.contact import Obstacle, Piece, first_contact
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.grid_map import Grid

BASE_RADIUS_M = 0.178  # kobuki.urdf.xacro
Point = Tuple[float, float]  # x, y [m]
FARTHEST_PLACE_M = 1e6  # limit of a robot's position
REACH_M = 1.0  # around a robot; after driving this far, its surroundings are chosen again
INSIDE_M = 1e-9  # how deep in a wall a robot may be placed
GRID_M = 0.5  # between robots that are lined up
ORIGIN: Pose = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class World:
    """walls: polylines; posts: x, y, radius; cliffs: polygons; start [m, rad]; grid: its map."""

    walls: tuple[tuple[Point, ...], ...] = ()
    posts: tuple[tuple[float, float, float], ...] = ()
    cliffs: tuple[tuple[Point, ...], ...] = ()
    start: Pose | None = None
    grid: Grid | None = None

    @cached_property
    def start_pose(self) -> Pose:
        """The start; else the origin or, in a map, a free place. Raises ValueError."""
        if self.start or not self.grid:
            return self.start or ORIGIN
        x, y, _ = place = self.grid.free_place(BASE_RADIUS_M)
        if hypot(x, y) < self.grid.resolution:  # about one cell
            with suppress(ValueError):
                self.check_place(ORIGIN)
                return ORIGIN
        return place

    @cached_property
    def segments(self) -> tuple[Obstacle, ...]:
        """The walls as segments."""
        return _pieces(self.walls)

    @cached_property
    def edges(self) -> tuple[Obstacle, ...]:
        """The edges of the cliffs as segments."""
        return _pieces((*line, line[0]) for line in self.cliffs)

    @cached_property
    def obstacles(self) -> tuple[Obstacle, ...]:
        """The walls and posts, which a robot can touch."""
        return (*self.segments, *((x, y, x, y, radius) for x, y, radius in self.posts))

    @cached_property
    def array(self) -> Any:
        """The obstacles as an array (n, 5)."""
        return np.array(self.obstacles).reshape(-1, 5)

    def is_cliff(self, x: float, y: float) -> bool:
        """Return whether there is no floor at (x, y) [m]."""
        return any(is_inside(x, y, cliff) for cliff in self.cliffs)

    def check_place(self, pose: Pose) -> None:
        """Raise ValueError if a robot cannot stand at a pose (x [m], y [m], yaw [rad])."""
        x, y, _ = pose
        is_inside_of_cells = self.grid is not None and self.grid.is_occupied(x, y)
        if is_inside_of_cells or (gaps(x, y, self.array) < BASE_RADIUS_M - INSIDE_M).any():
            raise ValueError(f"a robot at ({x:g}, {y:g}) would be inside a wall")
        edges = np.array(self.edges).reshape(-1, 5)
        if self.is_cliff(x, y) or (gaps(x, y, edges) < BASE_RADIUS_M).any():
            raise ValueError(f"a robot at ({x:g}, {y:g}) would be over an edge")

    def places(self, count: int) -> list[Pose]:
        """Return `count` start poses, GRID_M apart, which a robot can reach from the first one.

        The first is the start, and all have its heading. Raises ValueError for lack of room.
        """
        start = self.start_pose
        self.check_place(start)
        around = Surroundings(self)
        step = Piece((1.0, 0.0), (1.0, 0.0), GRID_M)
        poses = {(0, 0): start}
        for row, column in (reached := [(0, 0)]):  # grows in the loop
            px, py, _ = poses[row, column]
            obstacles = [*around.near(px, py, REACH_M), *self.edges]
            for k, (dr, dc) in enumerate(((0, -1), (-1, 0), (0, 1), (1, 0))):
                key = row + dr, column + dc
                if len(poses) >= count or key in poses:
                    continue
                way = px, py, start[2] - (k + 1) * pi / 2
                if first_contact(way, step, BASE_RADIUS_M, obstacles) is None:
                    poses[key] = composed(start, (GRID_M * key[0], GRID_M * key[1], 0.0))
                    reached.append(key)
        if len(poses) < count:
            raise ValueError(f"the world has room for {len(poses)} robots")
        return list(poses.values())


def _pieces(lines: Iterable[Sequence[Point]]) -> tuple[Obstacle, ...]:
    return tuple((*a, *b, 0.0) for line in lines for a, b in zip(line, line[1:]))


def gaps(x: Any, y: Any, obstacles: Any) -> Any:
    """Return the distances [m] of a point from obstacles (n, 5), or of points from an obstacle."""
    x1, y1, x2, y2, radius = np.transpose(obstacles)
    dx, dy = x2 - x1, y2 - y1
    length2 = np.maximum(dx * dx + dy * dy, 1e-300)
    share = np.clip(((x - x1) * dx + (y - y1) * dy) / length2, 0.0, 1.0)
    return np.hypot(x1 + share * dx - x, y1 + share * dy - y) - radius


def is_inside(x: Any, y: Any, polygon: Sequence[Point]) -> Any:
    """Return whether (x, y) [m], numbers or arrays, is inside a polygon, by ray casting."""
    crossed = False
    for (x1, y1), (x2, y2) in zip(polygon, (*polygon[1:], polygon[0])):
        if y1 != y2:
            crosses = ((y1 > y) != (y2 > y)) & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
            crossed = crosses ^ crossed
    return crossed


class Surroundings:
    """The obstacles of a World within REACH_M of one robot."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._at, self._within = (nan, nan), nan  # [m]; nothing is chosen yet
        self._near: list[Obstacle] = []

    def near(self, x: float, y: float, reach: float) -> Sequence[Obstacle]:
        """Return all obstacles within reach [m] of (x, y), and perhaps more."""
        if not hypot(x - self._at[0], y - self._at[1]) + reach <= self._within:
            self._at, self._within = (x, y), max(reach, REACH_M)
            is_near = gaps(x, y, self.world.array) <= self._within
            self._near = [self.world.obstacles[i] for i in np.flatnonzero(is_near)]
        return self._near
