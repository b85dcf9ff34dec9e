"""Systematic errors against the arcs of unequal wheels, noise against its own covariance."""

import numpy as np
import pytest

from fake_turtlebot_sim.simulator.differential_drive import arc
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

SECOND = 10**9  # [ns]


@pytest.mark.parametrize(("ratio", "track"), [(1.0, 1.0), (1.01, 1.0), (1.0, 1.03), (0.98, 0.97)])
def test_unequal_wheels_bend_the_true_path_and_the_estimate_knows_nothing(ratio, track):
    robot = SimulatedRobot(Parameters(wheel_radius_ratio=ratio, track_ratio=track))
    robot.command((0.5, 0.8), 0)
    robot.advance(SECOND // 2)
    half_track, left_size = 0.230 / 2, 2 / (1 + ratio)  # [m], [1]
    left = left_size * (0.5 - 0.8 * half_track)  # [m/s]
    right = ratio * left_size * (0.5 + 0.8 * half_track)  # [m/s]
    true = (left + right) / 2, (right - left) / (2 * half_track * track)
    for state, velocity in ((robot.state(), (0.5, 0.8)), (robot.true_state(), true)):
        assert state[:3] == pytest.approx(arc((0.0, 0.0, 0.0), velocity, 0.5), abs=1e-12)


def noisy_drive(seed, rate_hz, rest_s=0):
    """Drive an S of 6 s and return (robot at its end, odometry minus truth)."""
    noisy = Parameters(wheel_noise=0.01, seed=seed % 17, cmd_vel_timeout=1.5)
    robot = SimulatedRobot(noisy, name=f"robot_{seed // 17}")
    for k in range(6 * rate_hz):
        now_ns = rest_s * SECOND + k * SECOND // rate_hz
        robot.command((0.5, 1.0 if k < 3 * rate_hz else -1.0), now_ns)
    robot.advance((rest_s + 6) * SECOND)
    odometry, truth = robot.state(), robot.true_state()
    return robot, np.subtract(odometry[:3], truth[:3])


@pytest.mark.parametrize("rate_hz", [1, 20])
def test_the_covariance_is_that_of_the_errors_whatever_the_rate(rate_hz):
    drives = [noisy_drive(seed, rate_hz) for seed in range(300)]
    assert (noisy_drive(0, rate_hz, rest_s=2)[1] == drives[0][1]).all()  # a rest draws no noise
    sampled = np.cov(np.array([error for _, error in drives]).T)
    told = np.mean([robot.covariance() for robot, _ in drives], axis=0)
    # 300 samples know a variance to 8 %; the worst of six numbers may be three times as far off.
    scale = np.sqrt(np.outer(np.diag(told), np.diag(told)))
    assert np.abs(sampled - told).max() < 0.25 * scale.max()
    assert np.abs((sampled - told) / scale).max() < 0.25
