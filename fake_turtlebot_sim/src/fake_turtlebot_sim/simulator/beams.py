"""What a laser scanner measures among walls, posts and robots, exactly (pure, numpy).

Beams leave one point at even angles. Each obstacle is met by the beams between the directions in
which its ends are seen; only for these pairs is a distance computed.
"""

from __future__ import annotations

from math import cos, sin, tau
from typing import Any

import numpy as np

SLACK = 1e-9  # [rad] of the ends of a wall, so that no beam slips between two that meet


class Scanner:
    """Beams at angle_min + k * increment [rad], k from 0 to count - 1, from the sensor's middle.

    walls: an array (n, 4) of x1, y1, x2, y2 [m]; discs: (m, 3) of x, y, radius [m].
    count * increment is at most one turn.
    """

    def __init__(self, angle_min: float, increment: float, count: int) -> None:
        self._start, self._increment, self._count = angle_min, increment, count
        angles = angle_min + increment * np.arange(count)
        self._cos, self._sin = np.cos(angles), np.sin(angles)

    def ranges(self, pose: tuple[float, float, float], walls: Any, discs: Any) -> Any:
        """Return the distances [m] from a pose (x [m], y [m], yaw [rad]), else infinity."""
        x, y, yaw = pose
        found = []
        if len(walls):
            found.append(self._to_walls(*_seen_from(x, y, yaw, walls)))
        if len(discs):
            (px, py), _ = _seen_from(x, y, yaw, discs[:, [0, 1, 0, 1]])
            found.append(self._to_discs(px, py, discs[:, 2]))
        beams = np.concatenate([beams for beams, _ in found]) if found else np.empty(0, np.uint16)
        if not len(beams):
            return np.full(self._count, np.inf)
        return self._nearest(beams, np.concatenate([ranges for _, ranges in found]))

    def _nearest(self, beams: Any, ranges: Any) -> Any:
        """Return the least range of each beam; stable sorting of small integers is linear."""
        order = np.argsort(beams, kind="stable")
        beams, ranges = beams[order], ranges[order]
        first = np.flatnonzero(np.concatenate(([True], beams[1:] != beams[:-1])))
        found = np.full(self._count, np.inf)
        found[beams[first]] = np.minimum.reduceat(ranges, first)
        return found

    def _pairs(self, begin: Any, width: Any) -> tuple[Any, Any]:
        """Return (obstacle, beam) of all beams within width [rad] from begin [rad] on."""
        turn = (begin - self._start) % tau
        # Twice, as a wall may be met by the first beams and, beyond a turn, by the last ones.
        low = np.concatenate((turn, turn - tau)) / self._increment
        high = low + np.concatenate((width, width)) / self._increment
        low = np.maximum(np.ceil(low), 0).astype(np.int64)
        counts = np.minimum(np.floor(high), self._count - 1).astype(np.int64) - low + 1
        np.maximum(counts, 0, out=counts)
        obstacles = np.repeat(np.arange(len(counts)) % len(turn), counts)
        starts = np.cumsum(counts) - counts
        beams = np.arange(len(obstacles)) + np.repeat(low - starts, counts)
        return obstacles, beams.astype(np.uint16)

    def _to_walls(self, one: Any, other: Any) -> tuple[Any, Any]:
        (x1, y1), (x2, y2) = one, other
        cross = x1 * y2 - y1 * x2  # twice the area of the triangle that the scanner sees
        begin = np.where(cross >= 0, np.arctan2(y1, x1), np.arctan2(y2, x2))
        width = np.arctan2(np.abs(cross), x1 * x2 + y1 * y2)
        walls, beams = self._pairs(begin - SLACK, width + 2 * SLACK)
        dx, dy = x2 - x1, y2 - y1
        with np.errstate(divide="ignore", invalid="ignore"):
            ranges = cross[walls] / (self._cos[beams] * dy[walls] - self._sin[beams] * dx[walls])
        # A wall in line with the scanner is met at its nearer end.
        in_line = np.abs(cross) <= 1e-15 * np.hypot(dx, dy) * (np.abs(x1) + np.abs(y1))
        if in_line.any():
            ends = np.minimum(np.hypot(x1, y1), np.hypot(x2, y2))
            ranges = np.where(in_line[walls], ends[walls], ranges)
        return beams, np.where(ranges >= 0, ranges, np.inf)

    def _to_discs(self, x: Any, y: Any, radius: Any) -> tuple[Any, Any]:
        distance = np.hypot(x, y)
        inside = distance <= radius
        half = np.arcsin(np.minimum(1.0, radius / np.maximum(distance, 1e-300)))
        half = np.where(inside, tau / 2, half)
        discs, beams = self._pairs(np.arctan2(y, x) - half, 2 * half)
        along = self._cos[beams] * x[discs] + self._sin[beams] * y[discs]
        across = self._cos[beams] * y[discs] - self._sin[beams] * x[discs]
        chord = np.sqrt(np.maximum(0.0, (radius[discs] - across) * (radius[discs] + across)))
        ranges = along - chord
        return beams, np.where(inside[discs], 0.0, ranges)


def _seen_from(x: float, y: float, yaw: float, ends: Any) -> tuple[Any, Any]:
    """Return both ends (x [m], y [m]) of walls in the frame of a pose."""
    c, s = cos(yaw), sin(yaw)
    dx, dy = ends[:, 0::2] - x, ends[:, 1::2] - y
    ahead, aside = c * dx + s * dy, c * dy - s * dx
    return (ahead[:, 0], aside[:, 0]), (ahead[:, 1], aside[:, 1])
