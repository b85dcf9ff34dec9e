"""A scanner's ranges, compared with the crossings of each beam with each obstacle."""

import math

import numpy as np
import pytest

from fake_turtlebot_sim.simulator.differential_drive import composed
from fake_turtlebot_sim.simulator.laser import Laser, Scanner
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.world import World
from tutorial_testing.claims import claim


def crossings(pose, angles, walls, discs):
    """Return the range of each beam, computed in axes along and across it."""
    turned = np.exp(-1j * (pose[2] + angles))[:, None]
    x1, y1, x2, y2, px, py, radius = (column[None] for column in (*walls.T, *discs.T))
    a, b, post = (turned * (x + 1j * y - complex(*pose[:2])) for x, y in
                  ((x1, y1), (x2, y2), (px, py)))  # fmt: skip
    along = (a.real * b.imag - b.real * a.imag) / (b.imag - a.imag)
    to_walls = np.where((a.imag * b.imag <= 0) & (along >= 0), along, np.inf)
    chord = np.sqrt(np.maximum(radius**2 - post.imag**2, 0))
    is_met = (np.abs(post.imag) <= radius) & (post.real > 0)
    to_discs = np.where(is_met, post.real - chord, np.inf)
    to_discs = np.where(np.abs(post) <= radius, 0.0, to_discs)
    return np.minimum(to_walls.min(axis=1), to_discs.min(axis=1))


@claim("Each beam measures what is there")
@pytest.mark.parametrize("view", [1.0, math.tau])
def test_twenty_thousand_random_beams(view):
    random, count, far = np.random.default_rng(29), 500, 4.0
    angles = np.linspace(-view / 2, view / 2, count, endpoint=view < math.tau)
    given = SimulatorParameters(
        scan_angle=view, scan_beams=count, scan_range_min=0.0, scan_range_max=far
    )
    for _ in range(10):
        walls = random.uniform(-9, 9, (random.integers(1, 40), 4))
        posts = np.column_stack((random.uniform(-9, 9, (6, 2)), random.uniform(0.05, 0.5, 6)))
        lines = tuple(((x1, y1), (x2, y2)) for x1, y1, x2, y2 in walls)
        laser = Laser(given, World(lines, tuple(map(tuple, posts))))
        for pose in random.uniform(-6, 6, (4, 3)):
            expected = crossings(composed(pose, (-0.087, 0.0125, 0.0)), angles, walls, posts)
            expected[expected > far] = math.inf
            found = laser.measure(tuple(pose), np.empty((0, 5)))
            assert found == pytest.approx(expected, rel=0, abs=1e-9)


def test_a_wall_in_line_with_a_beam_is_met_at_its_end_and_nothing_is_far():
    wall, nothing = np.array([[5.0, 0.0, 2.0, 0.0]]), np.empty((0, 3))
    found = Scanner(0.0, 0.1, 2).ranges((0, 0, 0), wall, nothing)
    assert list(found) == [2.0, math.inf]
