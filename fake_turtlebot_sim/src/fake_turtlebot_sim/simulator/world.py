"""A world of walls, posts and cliffs, and what of it is near (pure)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import hypot, pi
from typing import Any, Sequence, Tuple

import numpy as np

from fake_turtlebot_sim.simulator.contact import Disc, Obstacle, Segment, first_contact, gap
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed

BASE_RADIUS_M = 0.178  # kobuki.urdf.xacro
Point = Tuple[float, float]  # x, y [m]
REACH_M = 1.0  # around a robot: what is farther away is looked at again only after so long a way
INSIDE_M = 1e-9  # how deep in a wall a robot may be put
GRID_M = 0.5  # between robots that are lined up


@dataclass(frozen=True)
class World:
    """walls: polylines; posts: discs; cliffs: polygons; start: of a robot [m, rad]."""

    walls: tuple[tuple[Point, ...], ...] = ()
    posts: tuple[Disc, ...] = ()
    cliffs: tuple[tuple[Point, ...], ...] = ()
    start: Pose = (0.0, 0.0, 0.0)

    @cached_property
    def segments(self) -> tuple[Segment, ...]:
        """The walls, piece by piece."""
        return tuple((*a, *b) for line in self.walls for a, b in zip(line, line[1:]))

    @cached_property
    def edges(self) -> tuple[Segment, ...]:
        """The edges of the cliffs, piece by piece."""
        closed = ((*line, line[0]) for line in self.cliffs)
        return tuple((*a, *b) for line in closed for a, b in zip(line, line[1:]))

    @cached_property
    def arrays(self) -> tuple[Any, Any]:
        """The walls (n, 4) and the posts (m, 3), as a Scanner takes them."""
        return np.array(self.segments).reshape(-1, 4), np.array(self.posts).reshape(-1, 3)

    def is_cliff(self, x: float, y: float) -> bool:
        """Return whether there is no floor at (x, y) [m]."""
        return any(is_inside(x, y, cliff) for cliff in self.cliffs)

    def check_place(self, pose: Pose) -> None:
        """Raise ValueError if a robot cannot stand at a pose (x [m], y [m], yaw [rad])."""
        x, y, _ = pose
        obstacles: tuple[Obstacle, ...] = (*self.segments, *self.posts)
        if any(gap(x, y, BASE_RADIUS_M, one) < -INSIDE_M for one in obstacles):
            raise ValueError(f"a robot at ({x:g}, {y:g}) would be inside of a wall")
        over = (gap(x, y, BASE_RADIUS_M, edge) < 0.0 for edge in self.edges)
        if self.is_cliff(x, y) or any(over):
            raise ValueError(f"a robot at ({x:g}, {y:g}) would be over an edge")

    def places(self, count: int) -> list[Pose]:
        """Return as many start poses, GRID_M apart, which a robot can reach from the first.

        The first is the start, and all have its heading. Raises ValueError if there is no room.
        """
        self.check_place(self.start)
        around = Surroundings(self)
        found = {(0, 0): self.start}
        reached = [(0, 0)]
        for row, column in reached:  # grows meanwhile
            px, py, _ = found[row, column]
            for k, (dr, dc) in enumerate(((0, -1), (-1, 0), (0, 1), (1, 0))):
                key = row + dr, column + dc
                if len(found) >= count or key in found:
                    continue
                way = px, py, self.start[2] - (k + 1) * pi / 2
                obstacles = [*around.near(px, py, REACH_M), *self.edges]
                if first_contact(way, (1.0, 0.0), GRID_M, BASE_RADIUS_M, obstacles) is None:
                    found[key] = composed(self.start, (GRID_M * key[0], GRID_M * key[1], 0.0))
                    reached.append(key)
        if len(found) < count:
            raise ValueError(f"the world has room for {len(found)} robots")
        return list(found.values())


def is_inside(x: Any, y: Any, polygon: Sequence[Point]) -> Any:
    """Return whether a ray from (x, y) [m], numbers or arrays, along x crosses a polygon oddly."""
    crossed = False
    for (x1, y1), (x2, y2) in zip(polygon, (*polygon[1:], polygon[0])):
        if y1 != y2:
            crosses = ((y1 > y) != (y2 > y)) & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
            crossed = crosses ^ crossed
    return crossed


class Surroundings:
    """The obstacles of a World within REACH_M of one robot."""

    def __init__(self, world: World) -> None:
        self._obstacles: tuple[Obstacle, ...] = (*world.segments, *world.posts)
        self._walls, self._posts = world.arrays
        self._at: Point | None = None
        self._near: list[Obstacle] = []

    def near(self, x: float, y: float, reach: float) -> Sequence[Obstacle]:
        """Return at least all obstacles within reach [m] of (x, y)."""
        if reach > REACH_M:
            return self._obstacles
        if self._at is None or hypot(x - self._at[0], y - self._at[1]) + reach > REACH_M:
            self._at = x, y
            distances = np.concatenate((self._to_walls(x, y), self._to_posts(x, y)))
            self._near = [self._obstacles[i] for i in np.flatnonzero(distances <= REACH_M)]
        return self._near

    def _to_walls(self, x: float, y: float) -> Any:
        start, way = self._walls[:, :2], self._walls[:, 2:] - self._walls[:, :2]
        to_robot = (x, y) - start
        length2 = np.maximum((way * way).sum(axis=1), 1e-300)
        share = np.clip((to_robot * way).sum(axis=1) / length2, 0.0, 1.0)
        return np.hypot(*(to_robot - share[:, None] * way).T)

    def _to_posts(self, x: float, y: float) -> Any:
        return np.hypot(self._posts[:, 0] - x, self._posts[:, 1] - y) - self._posts[:, 2]
