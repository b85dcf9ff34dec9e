"""A world of walls, posts and cliffs, and what of it is near (pure)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import hypot
from typing import Any, Sequence, Tuple

import numpy as np

from fake_turtlebot_sim.simulator.contact import Disc, Obstacle, Segment
from fake_turtlebot_sim.simulator.differential_drive import Pose

Point = Tuple[float, float]  # x, y [m]
REACH_M = 1.0  # around a robot: what is farther away is looked at again only after so long a way


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
    def arrays(self) -> tuple[Any, Any]:
        """The walls (n, 4) and the posts (m, 3), as a Scanner takes them."""
        return np.array(self.segments).reshape(-1, 4), np.array(self.posts).reshape(-1, 3)

    def is_cliff(self, x: float, y: float) -> bool:
        """Return whether there is no floor at (x, y) [m]."""
        return any(_is_inside(x, y, cliff) for cliff in self.cliffs)


def _is_inside(x: float, y: float, polygon: Sequence[Point]) -> bool:
    """Return whether a ray from (x, y) along x crosses a polygon an odd number of times."""
    crossed = False
    for (x1, y1), (x2, y2) in zip(polygon, (*polygon[1:], polygon[0])):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            crossed = not crossed
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
