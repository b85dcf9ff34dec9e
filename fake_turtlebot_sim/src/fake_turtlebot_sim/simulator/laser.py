"""What a laser scanner measures among walls, posts and robots, exactly (pure, numpy).

Beams leave one point at even angles. Each obstacle is met by the beams between the directions in
which its ends are seen; only for these pairs is a distance computed. Points are complex numbers.
"""

from __future__ import annotations

from cmath import rect
from math import hypot, inf, nan, tau
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.world import REACH_M, World, gaps

SLACK = 1e-9  # [rad] of the ends of a wall, so that no beam slips between two that meet


class Scanner:
    """Beams at angle_min + k * increment [rad], k from 0 to count - 1, at most one turn."""

    def __init__(self, angle_min: float, increment: float, count: int) -> None:
        self._start, self._increment, self._count = angle_min, increment, count
        self._ahead = np.exp(1j * (angle_min + increment * np.arange(count)))

    def ranges(self, pose: Pose, walls: Any, discs: Any) -> Any:
        """Return the distances [m] from a pose (x [m], y [m], yaw [rad]), else infinity.

        walls: an array (n, 4) of x1, y1, x2, y2 [m]; discs: (m, 3) of x, y, radius [m].
        """
        sensor, turn = complex(*pose[:2]), rect(1.0, -pose[2])
        one, other, middles = (
            (of[:, k] + 1j * of[:, k + 1] - sensor) * turn
            for of, k in ((walls, 0), (walls, 2), (discs, 0))
        )
        beams, ranges = self._to_walls(one, other)
        if len(discs):
            found = (beams, ranges), self._to_discs(middles, discs[:, 2])
            beams, ranges = (np.concatenate(parts) for parts in zip(*found))
        nearest = np.full(self._count, np.inf)
        if len(beams):
            order = np.argsort(beams, kind="stable")  # small integers: linear time
            beams, ranges = beams[order], ranges[order]
            first = np.flatnonzero(np.diff(beams, prepend=-1))
            nearest[beams[first]] = np.minimum.reduceat(ranges, first)
        return nearest

    def _pairs(self, begin: Any, width: Any) -> tuple[Any, Any]:
        """Return (obstacle, beam) of all beams within width [rad] from begin [rad] on."""
        turn = (begin - self._start) % tau
        # Twice, as a wall may be met by the first beams and, beyond a turn, by the last ones.
        low = np.concatenate((turn, turn - tau)) / self._increment
        high = low + np.concatenate((width, width)) / self._increment
        low = np.maximum(np.ceil(low), 0).astype(np.int64)
        counts = np.minimum(np.floor(high), self._count - 1).astype(np.int64) - low + 1
        np.maximum(counts, 0, out=counts)
        obstacles = np.repeat(np.arange(len(counts)) % max(1, len(turn)), counts)
        beams = np.arange(len(obstacles)) + np.repeat(low - np.cumsum(counts) + counts, counts)
        return obstacles, beams.astype(np.int16)

    def _to_walls(self, one: Any, other: Any) -> tuple[Any, Any]:
        product, way = one.conj() * other, other - one
        cross = product.imag  # twice the area of the triangle that the scanner sees
        begin = np.angle(np.where(cross >= 0, one, other))
        width = np.arctan2(np.abs(cross), product.real)
        walls, beams = self._pairs(begin - SLACK, width + 2 * SLACK)
        with np.errstate(divide="ignore", invalid="ignore"):
            ranges = cross[walls] / (self._ahead[beams].conj() * way[walls]).imag
        # A wall in line with the scanner is met at its nearer end.
        in_line = np.abs(cross) <= 1e-15 * np.abs(way) * np.abs(one)
        if in_line.any():
            ends = np.minimum(np.abs(one), np.abs(other))
            ranges = np.where(in_line[walls], ends[walls], ranges)
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
    """Measures the ranges of one scan on a robot; each name draws noise of its own."""

    def __init__(self, parameters: SimulatorParameters, world: World, name: str = "") -> None:
        """Take the scan_... of the SimulatorParameters; beams are spread evenly over the angle."""
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

        others: an array (n, 5) of obstacles beside the world's. What is nearer than the least range
        is -inf, beyond the largest inf, by REP-117; or both NaN, as depthimage_to_laserscan fills.
        """
        p = self._parameters
        x, y, _ = sensor = composed(pose, (p.scan_x, p.scan_y, 0.0))
        if not hypot(x - self._at[0], y - self._at[1]) < REACH_M:  # choose again what is in reach
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
