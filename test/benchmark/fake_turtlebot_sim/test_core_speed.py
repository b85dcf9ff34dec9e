"""The core without ROS: how many times faster than real time, at 50 Hz."""

import numpy as np

from fake_turtlebot_sim.replay.bag_replay import replay
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

PERIOD_NS = 20_000_000
PERIOD_S = 0.02


def check(benchmark, figure, what, simulated_s, least):
    """Note the speed of the best round."""
    speed = simulated_s / benchmark.stats.stats.min
    figure(what, f"{speed:,.0f} times real time", f"≥ {least:,}")
    assert speed >= least


def test_simulated_robot(benchmark, figure):
    steps = 2_000
    commands = [(0.7 * np.sin(k), 3.0 * np.cos(k)) for k in range(steps)]

    def drive():
        robot = SimulatedRobot(Parameters())
        for k, command in enumerate(commands):
            # A command in each period, in the middle of it, so that each step is split.
            robot.command(command, k * PERIOD_NS + PERIOD_NS // 2)
            robot.advance((k + 1) * PERIOD_NS)
            robot.state()

    benchmark(drive)
    what = "robot: commands, limits, timeout, state"
    check(benchmark, figure, what, steps * PERIOD_S, 2_000)


def test_replay_of_an_hour(benchmark, figure, tmp_path):
    commands = [(k * 50_000_000, (0.5, 0.3 * (-1) ** (k // 60))) for k in range(3600 * 20)]
    run = lambda: replay(commands, tmp_path / "hour.bag", Parameters())  # noqa: E731
    benchmark.pedantic(run, rounds=1)
    check(benchmark, figure, "replay of an hour, output bag written", 3600, 100)
