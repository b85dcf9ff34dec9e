"""A world as a grid of free and occupied cells, as map servers have it (pure, numpy)."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.world import Point, World, is_inside

MARGIN_M = 0.5  # of free cells around everything
MOST_CELLS = 4_000_000
OCCUPIED, UNKNOWN = 100, -1  # nav_msgs/OccupancyGrid; 0: free


def occupancy(world: World, resolution: float = 0.05) -> tuple[Any, Point, float]:
    """Return cells (rows from low y to high), the corner (x, y) of the first, and the cell [m].

    Occupied is a cell with a wall, a post or the edge of a cliff in it; unknown, one over a cliff.
    A world too large for MOST_CELLS of the resolution [m] gets larger ones.
    """
    segments = np.array((*world.segments, *world.edges)).reshape(-1, 4)
    posts = world.arrays[1]
    corners = np.concatenate(
        (segments[:, :2], segments[:, 2:], posts[:, :2] - posts[:, 2:], posts[:, :2] + posts[:, 2:])
    )
    low, high = (corners.min(axis=0), corners.max(axis=0)) if len(corners) else (0.0, 0.0)
    low, high = np.zeros(2) + low - MARGIN_M, np.zeros(2) + high + MARGIN_M
    resolution = max(resolution, float(np.sqrt((high - low).prod() / MOST_CELLS)))
    columns, rows = np.ceil((high - low) / resolution).astype(int)
    cells = np.zeros((rows, columns), dtype=np.int8)
    xs, ys = (at + (np.arange(n) + 0.5) * resolution for at, n in zip(low, (columns, rows)))
    for cliff in world.cliffs:
        cells[is_inside(xs, ys[:, None], cliff)] = UNKNOWN
    for x1, y1, x2, y2 in segments:
        steps = ceil(4 * np.hypot(x2 - x1, y2 - y1) / resolution) + 1
        line = np.linspace((x1, y1), (x2, y2), steps)
        at = ((line - low) / resolution).astype(int)
        cells[at[:, 1], at[:, 0]] = OCCUPIED
    for x, y, radius in posts:
        reach = radius + 0.5 * resolution
        near = np.flatnonzero(np.abs(ys - y) <= reach), np.flatnonzero(np.abs(xs - x) <= reach)
        disc = np.hypot(xs[near[1]] - x, ys[near[0], None] - y) <= reach
        cells[np.ix_(*near)] = np.where(disc, OCCUPIED, cells[np.ix_(*near)])
    return cells, (float(low[0]), float(low[1])), resolution
