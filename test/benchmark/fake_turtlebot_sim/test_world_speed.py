"""A world: rays of the laser beside IR-SIM's, contact, and a class that scans in the maze."""

import json
import os
import subprocess
import time
from pathlib import Path
from random import Random
from statistics import median

import numpy as np
import pytest
from live import FAKE_TURTLEBOT, HERE, lost_periods, master, observe, topics_of

from fake_turtlebot_sim.simulator.laser import Scanner
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot, meet
from fake_turtlebot_sim.simulator.world import World

WALLS, BEAMS, RANGE_M, SCANS = 100, 640, 30.0, 200
PERIOD_NS = 20_000_000
ROBOTS, SECONDS = 30, 20
LEAST_RATIO, MOST_STEP_S, MOST_LOAD = 8.0, 1e-3, 0.3


def walls(seed=1):
    """Return walls in a square of 40 m, as an array (n, 4), with a free place in its middle."""
    draw, found = Random(seed), []
    while len(found) < WALLS:
        x, y = draw.uniform(1, 39), draw.uniform(1, 39)
        if max(abs(x - 20), abs(y - 20)) > 3:
            found.append([x, y, x + draw.uniform(-2, 2), y + draw.uniform(-2, 2)])
    return np.array(found)


@pytest.fixture(scope="module")
def irsim():
    """The Python of an environment with IR-SIM from PyPI, made once."""
    folder = Path(os.environ["TUTORIAL_RESULTS"]) / "irsim"
    python = folder / "bin" / "python"
    if not (folder / "made").exists():
        subprocess.run(["/usr/bin/python3", "-m", "venv", str(folder)], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "ir-sim==2.12.0"], check=True)
        (folder / "made").touch()
    return str(python)


def test_rays_a_second_beside_irsim(irsim, figure, tmp_path):
    file = tmp_path / "walls.json"
    file.write_text(json.dumps(walls().tolist()))
    one_core = {**os.environ, "OMP_NUM_THREADS": "1"}
    words = ["taskset", "-c", "0", irsim, str(HERE / "irsim_scan.py"), str(file)]
    words += [str(BEAMS), str(RANGE_M), str(SCANS)]
    done = subprocess.run(words, env=one_core, stdout=subprocess.PIPE, text=True, check=True)
    theirs_s = float(done.stdout.split()[-1])
    scanner, times = Scanner(-3.14, 6.28 / (BEAMS - 1), BEAMS), []
    segments, no_posts = walls(), np.empty((0, 3))
    for _ in range(SCANS):
        began = time.perf_counter()
        ranges = scanner.ranges((20.0, 20.0, 0.0), segments, no_posts)
        times.append(time.perf_counter() - began)
    ours_s = median(times)
    assert np.isfinite(ranges).sum() > BEAMS / 10
    ratio = theirs_s / ours_s
    rays = f"{BEAMS / ours_s / 1e6:.2f} million, IR-SIM's {BEAMS / theirs_s / 1e6:.2f}: {ratio:.1f}"
    figure(f"rays a second, {BEAMS} beams among {WALLS} walls", rays, f"≥ {LEAST_RATIO:.0f} times")
    assert ratio >= LEAST_RATIO


def test_a_step_of_a_hundred_robots_with_contact(figure):
    world = World(tuple(((x1, y1), (x2, y2)) for x1, y1, x2, y2 in walls()))
    parameters, draw, robots = Parameters(world=world), Random(2), []
    while len(robots) < 100:
        pose = draw.uniform(0, 40), draw.uniform(0, 40), draw.uniform(-3, 3)
        places = np.array([robot.true_pose[:2] for robot in robots]).reshape(-1, 2)
        if (np.hypot(*(places - pose[:2]).T) < 0.4).any():
            continue
        try:
            robots.append(SimulatedRobot(parameters, pose, str(len(robots))))
        except ValueError:
            continue  # there is a wall
    velocities = [(draw.uniform(-0.3, 0.7), draw.uniform(-1, 1)) for _ in robots]
    times = []
    for cycle in range(1000):
        for robot, velocity in zip(robots, velocities):
            robot.command(velocity, cycle * PERIOD_NS)
        began = time.perf_counter()
        meet(robots, parameters.meeting_reach())
        for robot in robots:
            robot.advance((cycle + 1) * PERIOD_NS)
        times.append(time.perf_counter() - began)
    assert any(robot.contact is not None for robot in robots)
    step_s = median(times)
    shown = f"{step_s * 1e3:.2f} ms"
    figure("a step of 100 robots among 100 walls, and each other", shown, "≤ 1 ms")
    assert step_s <= MOST_STEP_S


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
