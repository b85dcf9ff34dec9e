"""Systematic errors compared with arcs of unequal wheels, noise with its own covariance."""

import numpy as np
import pytest

from fake_turtlebot_sim.simulator.differential_drive import arc, wheel_rates
from fake_turtlebot_sim.simulator.odometry_errors import OdometryErrors
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from tutorial_testing.claims import claim

pytestmark = claim(
    "Unequal wheels bend the true path, noise spoils the measurement, and the covariance is that "
    "of the errors"
)
SECOND = 10**9  # [ns]


@pytest.mark.parametrize(("ratio", "track"), [(1.0, 1.0), (1.01, 1.0), (1.0, 1.03), (0.98, 0.97)])
def test_unequal_wheels_bend_the_true_path_and_the_estimate_knows_nothing(ratio, track):
    robot = SimulatedRobot(SimulatorParameters(wheel_radius_ratio=ratio, track_ratio=track))
    robot.command((0.5, 0.8), 0)
    robot.advance(SECOND // 2)
    half_track, left_size = 0.230 / 2, 2 / (1 + ratio)  # [m], [1]
    left = left_size * (0.5 - 0.8 * half_track)  # [m/s]
    right = ratio * left_size * (0.5 + 0.8 * half_track)  # [m/s]
    true = (left + right) / 2, (right - left) / (2 * half_track * track)
    for state, velocity in ((robot.state(), (0.5, 0.8)), (robot.true_state(), true)):
        assert state[:3] == pytest.approx(arc((0.0, 0.0, 0.0), velocity, 0.5), abs=1e-12)


def test_a_step_errs_as_its_wheels_and_the_covariance_as_small_errors_move_its_end():
    separation, noise, dt = 0.23, 0.02, 0.03  # [m], [m] after 1 m, [s]
    errors = OdometryErrors(separation, wheel_noise=noise, seed="ada")
    pose, velocity = (0.3, -0.2, 0.7), (-0.3, 2.0)
    ways = np.array(wheel_rates(velocity, separation, 1.0 / dt))  # [m], left and right
    measured = [errors.measured(velocity, dt) for _ in range(1000)]
    drawn = np.array([wheel_rates(one, separation, 1.0 / dt) for one in measured])
    variances = noise**2 * np.abs(ways)
    assert np.mean((drawn - ways) ** 2, axis=0) == pytest.approx(variances, rel=0.2)

    def end(x, y, yaw, left, right):
        v, w = (left + right) / 2 / dt, (right - left) / separation / dt
        return np.array(arc((x, y, yaw), (v, w), dt))

    at, before = [*pose, *ways], np.array([[4, 1, 2], [1, 9, -3], [2, -3, 5]]) * 1e-6
    slopes = np.transpose([(end(*at + d) - end(*at - d)) / 2e-5 for d in 1e-5 * np.eye(5)])
    by_pose, by_wheels = slopes[:, :3], slopes[:, 3:]
    errors.covariance = before
    errors.grow(pose, end(*at), velocity, dt)
    after = by_pose @ before @ by_pose.T + by_wheels @ np.diag(variances) @ by_wheels.T
    assert errors.covariance == pytest.approx(after, rel=2e-3)


@pytest.mark.parametrize("rate_hz", [4, 20])
def test_the_covariance_is_that_of_the_errors_whatever_the_rate(rate_hz):
    errors, told = [], []
    for seed in range(300):
        robot = SimulatedRobot(SimulatorParameters(wheel_noise=0.01, seed=seed))
        for k in range(6 * rate_hz):
            robot.command((0.5, 1.0 if k < 3 * rate_hz else -1.0), k * SECOND // rate_hz)  # an S
        robot.advance(6 * SECOND)
        errors.append(np.subtract(robot.state()[:3], robot.true_state()[:3]))
        told.append(robot.covariance())
    sampled, mean = np.cov(np.transpose(errors)), np.mean(told, axis=0)
    # 300 samples give a variance to within 8 %; the worst of six may be three times as far off.
    scale = np.sqrt(np.outer(np.diag(mean), np.diag(mean)))
    assert np.abs((sampled - mean) / scale).max() < 0.25
