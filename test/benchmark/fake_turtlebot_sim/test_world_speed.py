"""A world: contact, and a class that scans in the maze."""

import time
from random import Random
from statistics import median

import numpy as np
from live import FAKE_TURTLEBOT, lost_periods, master, observe, topics_of

from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot, meet
from fake_turtlebot_sim.simulator.world import World

WALLS, BEAMS = 100, 640
PERIOD_NS = 20_000_000
ROBOTS, SECONDS = 30, 20
MOST_STEP_S, MOST_LOAD = 1e-3, 0.3


def walls(seed=1):
    """Return walls in a square of 40 m, as an array (n, 4), with a free place in its middle."""
    draw, found = Random(seed), []
    while len(found) < WALLS:
        x, y = draw.uniform(1, 39), draw.uniform(1, 39)
        if max(abs(x - 20), abs(y - 20)) > 3:
            found.append([x, y, x + draw.uniform(-2, 2), y + draw.uniform(-2, 2)])
    return np.array(found)


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
