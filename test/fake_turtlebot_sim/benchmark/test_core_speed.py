"""A replay without ROS: how many times faster than real time."""

from fake_turtlebot_sim.ros.bag_replay import replay
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from tutorial_testing.claims import claim

LEAST = 100


@claim("The simulator's figures, of a class that scans too", because="without ROS")
def test_replay_of_an_hour(benchmark, figure, tmp_path):
    commands = [(k * 50_000_000, (0.5, 0.3 * (-1) ** (k // 60))) for k in range(3600 * 20)]
    run = lambda: replay(commands, tmp_path / "hour.bag", SimulatorParameters())  # noqa: E731
    benchmark.pedantic(run, rounds=1)
    speed = 3600 / benchmark.stats.stats.min
    what = "replay of an hour, output bag written"
    figure(what, f"{speed:,.0f} times real time", f"≥ {LEAST}")
    assert speed >= LEAST
