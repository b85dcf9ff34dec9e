"""The ranges that a laser scanner measures among walls, posts and robots, exactly.

Beams leave one point at even angles. An obstacle is met by the beams between the directions of its
ends; only for these pairs is a distance computed. Points are complex numbers.
"""

from __future__ import annotations

from cmath import rect
from math import hypot, inf, nan, tau
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.world import REACH_M, World, gaps

SLACK = 1e-9  # [rad] at the ends of a wall, so that no beam passes between two that meet


class Scanner:
    """Beams at angle_min + k * increment [rad], k from 0 to count - 1, in at most one turn."""

    def __init__(self, angle_min: float, increment: float, count: int) -> None:
        self._start, self._increment, self._count = angle_min, increment, count
        self._ahead = np.exp(1j * (angle_min + increment * np.arange(count)))

    def ranges(self, pose: Pose, walls: Any, discs: Any) -> Any:
        """Return each beam's distance [m] from a pose (x [m], y [m], yaw [rad]), or infinity.

        walls: an array (n, 4) of x1, y1, x2, y2 [m]; discs: (m, 3) of x, y, radius [m].
        """
        sensor, turn = complex(*pose[:2]), rect(1.0, -pose[2])
        starts, ends, middles = (
            (of[:, k] + 1j * of[:, k + 1] - sensor) * turn
            for of, k in ((walls, 0), (walls, 2), (discs, 0))
        )
        beams, ranges = self._to_walls(starts, ends)
        if len(discs):
            pairs = (beams, ranges), self._to_discs(middles, discs[:, 2])
            beams, ranges = (np.concatenate(parts) for parts in zip(*pairs))
        nearest = np.full(self._count, np.inf)
        if len(beams):
            order = np.argsort(beams, kind="stable")  # small integers: linear time
            beams, ranges = beams[order], ranges[order]
            first = np.flatnonzero(np.diff(beams, prepend=-1))
            nearest[beams[first]] = np.minimum.reduceat(ranges, first)
        return nearest

    def _pairs(self, begin: Any, width: Any) -> tuple[Any, Any]:
        """Return (obstacle, beam) for all beams from begin [rad] to begin + width."""
        turn = (begin - self._start) % tau
        # Twice, as the first beams and, a turn later, the last beams may meet the same wall.
        low = np.concatenate((turn, turn - tau)) / self._increment
        high = low + np.concatenate((width, width)) / self._increment
        low = np.maximum(np.ceil(low), 0).astype(np.int64)
        counts = np.minimum(np.floor(high), self._count - 1).astype(np.int64) - low + 1
        np.maximum(counts, 0, out=counts)
        obstacles = np.repeat(np.arange(len(counts)) % max(1, len(turn)), counts)
        beams = np.arange(len(obstacles)) + np.repeat(low - np.cumsum(counts) + counts, counts)
        return obstacles, beams.astype(np.int16)

    def _to_walls(self, starts: Any, ends: Any) -> tuple[Any, Any]:
        product, way = starts.conj() * ends, ends - starts
        cross = product.imag  # twice the area of the triangle that the scanner sees
        begin = np.angle(np.where(cross >= 0, starts, ends))
        width = np.arctan2(np.abs(cross), product.real)
        walls, beams = self._pairs(begin - SLACK, width + 2 * SLACK)
        with np.errstate(divide="ignore", invalid="ignore"):
            ranges = cross[walls] / (self._ahead[beams].conj() * way[walls]).imag
        # Beams meet a wall in line with the scanner at its nearer end.
        in_line = np.abs(cross) <= 1e-15 * np.abs(way) * np.abs(starts)
        if in_line.any():
            nearer = np.minimum(np.abs(starts), np.abs(ends))
            ranges = np.where(in_line[walls], nearer[walls], ranges)
        return beams, np.where(ranges >= 0, ranges, np.inf)

    def _to_discs(self, middles: Any, radius: Any) -> tuple[Any, Any]:
        distance = np.abs(middles)
        inside = distance <= radius
        half = np.arcsin(np.minimum(1.0, radius / np.maximum(distance, 1e-300)))
        half = np.where(inside, tau / 2, half)
        discs, beams = self._pairs(np.angle(middles) - half, 2 * half)
        offset, radius = self._ahead[beams].conj() * middles[discs], radius[discs]
        chord2 = (radius - offset.imag) * (radius + offset.imag)
        ranges = offset.real - np.sqrt(np.maximum(0.0, chord2))
        return beams, np.where(inside[discs], 0.0, ranges)


class Laser:
    """The laser scanner of one robot; each name has noise of its own."""

    def __init__(self, parameters: SimulatorParameters, world: World, name: str = "") -> None:
        """Take the parameters scan_...; the beams are spread evenly over the angle."""
        p = self._parameters = parameters
        gaps = p.scan_beams if p.scan_angle >= tau else max(1, p.scan_beams - 1)
        self.angle_min, self.increment = -0.5 * p.scan_angle, p.scan_angle / gaps
        self._scanner = Scanner(self.angle_min, self.increment, p.scan_beams)
        self._obstacles, self._at = world.array, (nan, nan)
        self._far, self._near = (nan, nan) if p.scan_no_return == "nan" else (inf, -inf)
        seed = [p.seed % 2**32, *name.encode()]
        self._noise = np.random.default_rng(seed) if p.scan_noise else None

    def measure(self, pose: Pose, others: Any) -> list[float]:
        """Return the range of each beam [m] for a robot at a pose (x [m], y [m], yaw [rad]).

        others: an array (n, 5) of obstacles that the world does not have. A range below the least
        one is -inf, a range above the largest inf, by REP-117; or both are NaN, as with
        depthimage_to_laserscan.
        """
        p = self._parameters
        x, y, _ = sensor = composed(pose, (p.scan_x, p.scan_y, 0.0))
        if (
            not hypot(x - self._at[0], y - self._at[1]) < REACH_M
        ):  # choose the obstacles in reach again
            self._at, reach = (x, y), p.scan_range_max + REACH_M
            near = self._obstacles[gaps(x, y, self._obstacles) <= reach]
            self._walls, self._posts = near[near[:, 4] == 0.0], near[near[:, 4] > 0.0]
        discs = np.concatenate((self._posts, others))[:, 2:]
        ranges: Any = self._scanner.ranges(sensor, self._walls, discs)
        if self._noise is not None:
            ranges = ranges + self._noise.normal(0.0, p.scan_noise, p.scan_beams)
        ranges[ranges > p.scan_range_max] = self._far
        ranges[ranges < p.scan_range_min] = self._near
        measured: list[float] = ranges.tolist()
        return measured
