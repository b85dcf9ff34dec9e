"""What a scanner measures, against shapely, which knows nothing of angles."""

import math

import numpy as np
import pytest
from shapely.geometry import LineString, MultiLineString, Point

from fake_turtlebot_sim.simulator.laser import Scanner

EXACT = 1e-9
FAR = 100.0  # [m]


def oracle(pose, angles, walls, discs):
    """The range of each beam by the crossing of two lines, or with a circle's equation."""
    x, y, yaw = pose
    lines = MultiLineString([LineString([wall[:2], wall[2:]]) for wall in walls])
    for angle in yaw + angles:
        c, s = math.cos(angle), math.sin(angle)
        met = LineString([(x, y), (x + FAR * c, y + FAR * s)]).intersection(lines)
        ranges = [math.inf if met.is_empty else Point(x, y).distance(met)]
        for px, py, radius in discs:
            along, across = (px - x) * c + (py - y) * s, (py - y) * c - (px - x) * s
            if math.hypot(px - x, py - y) <= radius:
                ranges.append(0.0)
            elif along > 0 and abs(across) <= radius:
                ranges.append(along - math.sqrt(radius**2 - across**2))
        yield min(ranges)


@pytest.mark.parametrize("view", [1.0, math.tau])
def test_a_hundred_thousand_random_beams(view):
    random, count, worst = np.random.default_rng(29), 500, 0.0
    angles = -view / 2 + view / count * np.arange(count)
    scanner = Scanner(angles[0], view / count, count)
    for _ in range(100):
        walls = random.uniform(-5, 5, (random.integers(1, 20), 4))
        discs = np.column_stack((random.uniform(-5, 5, (3, 2)), random.uniform(0.05, 0.5, 3)))
        pose = tuple(random.uniform(-3, 3, 3))
        expected = np.array(list(oracle(pose, angles, walls, discs)))
        found = scanner.ranges(pose, walls, discs)
        assert (np.isinf(found) == np.isinf(expected)).all()
        seen = np.isfinite(found)
        worst = max(worst, np.abs(found[seen] - expected[seen]).max(initial=0.0))
    assert worst < EXACT


def test_a_wall_in_line_with_a_beam_is_met_at_its_end_and_nothing_is_far():
    found = Scanner(0.0, 0.1, 2).ranges(
        (0, 0, 0), np.array([[5.0, 0.0, 2.0, 0.0]]), np.empty((0, 3))
    )
    assert list(found) == [2.0, math.inf]
