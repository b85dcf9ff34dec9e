"""A laser scanner on a robot: its place, its angles, its range and its noise (pure)."""

from __future__ import annotations

from math import tau
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.beams import Scanner
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.world import World


class Laser:
    """Measures the ranges of one scan; each name draws noise of its own."""

    def __init__(self, parameters: Parameters, world: World, name: str = "") -> None:
        """Take the scan_... of the Parameters; beams are spread evenly over the angle."""
        p = self._parameters = parameters
        gaps = p.scan_beams if p.scan_angle >= tau else max(1, p.scan_beams - 1)
        self.angle_min = -0.5 * p.scan_angle
        self.increment = p.scan_angle / gaps
        self._world = world
        self._scanner = Scanner(self.angle_min, self.increment, p.scan_beams)
        seed = [p.seed % 2**32, *name.encode()]
        self._noise = np.random.default_rng(seed) if p.scan_noise else None

    def measure(self, pose: Pose, others: Any) -> list[float]:
        """Return the range of each beam [m] for a robot at a pose (x [m], y [m], yaw [rad]).

        others: discs (n, 3) of x, y, radius [m] beside the world's. What is nearer than the least
        range is -inf, beyond the largest inf, as REP-117 has it.
        """
        p, (walls, posts) = self._parameters, self._world.arrays
        sensor = composed(pose, (p.scan_x, p.scan_y, 0.0))
        ranges: Any = self._scanner.ranges(sensor, walls, np.concatenate((posts, others)))
        if self._noise is not None:
            ranges = ranges + self._noise.normal(0.0, p.scan_noise, p.scan_beams)
        ranges[ranges > p.scan_range_max] = np.inf
        ranges[ranges < p.scan_range_min] = -np.inf
        measured: list[float] = ranges.tolist()
        return measured
