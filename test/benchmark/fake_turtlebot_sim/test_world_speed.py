"""A world: rays of the laser, and a class that scans in the maze."""

import time
from random import Random
from statistics import median

import numpy as np
from live import FAKE_TURTLEBOT, lost_periods, master, observe, topics_of

from fake_turtlebot_sim.simulator.laser import Scanner

WALLS, BEAMS = 100, 640
ROBOTS, SECONDS = 30, 20
LEAST_MILLION, MOST_LOAD = 2.0, 0.3


def walls(seed=1):
    """Return walls in a square of 40 m, as an array (n, 4), with a free place in its middle."""
    draw, found = Random(seed), []
    while len(found) < WALLS:
        x, y = draw.uniform(1, 39), draw.uniform(1, 39)
        if max(abs(x - 20), abs(y - 20)) > 3:
            found.append([x, y, x + draw.uniform(-2, 2), y + draw.uniform(-2, 2)])
    return np.array(found)


def test_rays_a_second(figure):
    scanner, times = Scanner(-3.14, 6.28 / (BEAMS - 1), BEAMS), []
    segments = walls()
    for _ in range(200):
        began = time.perf_counter()
        ranges = scanner.ranges((20.0, 20.0, 0.0), segments, np.empty((0, 3)))
        times.append(time.perf_counter() - began)
    assert np.isfinite(ranges).sum() > BEAMS / 10
    million = BEAMS / median(times) / 1e6
    what = f"rays a second, {BEAMS} beams among {WALLS} walls"
    figure(what, f"{million:.1f} million", f"≥ {LEAST_MILLION}")
    assert million >= LEAST_MILLION


def test_a_class_that_scans_in_the_maze(figure):
    robots = [*FAKE_TURTLEBOT, "_world:=maze", f"_robots:={ROBOTS}"]
    with master():
        heard, (load,) = observe([robots], topics_of(ROBOTS, "odom", "scan"), SECONDS)
    lost = lost_periods({one: heard[one] for one in topics_of(ROBOTS, "odom")[1:]})
    rate = sum(len(heard[one]["arrivals"]) for one in topics_of(ROBOTS, "scan")[1:]) / SECONDS
    shown = f"{rate:,.0f} scans a second, {lost} periods lost, {load:.0%} of a core"
    figure(f"{ROBOTS} robots that scan with {BEAMS} beams in the maze", shown, "0 lost, ≤ 30 %")
    assert lost == 0
    assert rate > 0.98 * ROBOTS * 10
    assert load <= MOST_LOAD
