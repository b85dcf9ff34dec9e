"""Systematic errors against UMBmark's closed form, noise against its own covariance."""

from cmath import exp
from math import hypot, pi

import numpy as np
import pytest

from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

SECOND = 10**9  # [ns]
SEPARATION = 0.230  # [m]
# A side of 4 m at 0.5 m/s, then a quarter turn at pi/4 rad/s, in pieces shorter than the timeout.
SIDE, TURN = (0.5, 0.0, 8 * SECOND), (0.0, pi / 4, 2 * SECOND)


def drive_square(robot, way):
    """Drive the square of 4 x 4 m, counter-clockwise (way 1) or clockwise (-1)."""
    now_ns = 0
    for v, w, duration_ns in [SIDE, TURN] * 4:
        for _ in range(0, duration_ns, SECOND // 2):
            robot.command((v, way * w), now_ns)
            now_ns += SECOND // 2
            robot.advance(now_ns)
    robot.command((0.0, 0.0), now_ns)
    robot.advance(now_ns)


def true_end_of_square(way, ratio, track):
    """Where the square of the actual robot ends, (x [m], y [m], yaw [rad]), by complex numbers.

    Wheels of unequal size bend a side of length L to a chord and a turn by
    b = L (c_right - c_left) / track, and swing a turn on the spot about its middle.
    """
    c_left, c_right = 2 / (1 + ratio), 2 * ratio / (1 + ratio)
    actual = track * SEPARATION
    bend = 4.0 * (c_right - c_left) / actual
    corner = way * pi / 2 / track
    drift = way * (pi / 2) * SEPARATION / 2 * (c_right - c_left) / 2  # m driven while turning
    at, heading = 0j, 1 + 0j
    for _ in range(4):
        for length, angle in ((4.0, bend), (drift, corner)):
            chord = (exp(1j * angle) - 1) / (1j * angle) if angle else 1.0
            at += heading * length * chord
            heading *= exp(1j * angle)
    return at.real, at.imag, heading


@pytest.mark.parametrize("way", [1, -1], ids=["counter-clockwise", "clockwise"])
@pytest.mark.parametrize(("ratio", "track"), [(1.0, 1.0), (1.01, 1.0), (1.0, 1.03), (0.98, 0.97)])
def test_umbmark(way, ratio, track):
    robot = SimulatedRobot(Parameters(wheel_radius_ratio=ratio, track_ratio=track))
    drive_square(robot, way)
    odometry, truth = robot.state(), robot.true_state()
    assert odometry[:3] == pytest.approx((0, 0, 0), abs=1e-9)  # its estimate is home
    x, y, heading = true_end_of_square(way, ratio, track)
    assert truth[:2] == pytest.approx((x, y), rel=0, abs=1e-9)
    assert exp(1j * truth.yaw) == pytest.approx(heading, abs=1e-9)
    if (ratio, track) != (1.0, 1.0):
        assert hypot(*truth[:2]) > 0.05


def noisy_drive(seed, rate_hz):
    """Drive an S of 6 s and return (robot at its end, odometry minus truth)."""
    robot = SimulatedRobot(Parameters(wheel_noise=0.01, seed=seed))
    for k in range(6 * rate_hz):
        robot.command((0.5, 1.0 if k < 3 * rate_hz else -1.0), k * SECOND // rate_hz)
    robot.advance(6 * SECOND)
    odometry, truth = robot.state(), robot.true_state()
    return robot, np.subtract(odometry[:3], truth[:3])


@pytest.mark.parametrize("rate_hz", [4, 20])
def test_the_covariance_is_that_of_the_errors_whatever_the_rate(rate_hz):
    drives = [noisy_drive(seed, rate_hz) for seed in range(300)]
    sampled = np.cov(np.array([error for _, error in drives]).T)
    told = np.mean([robot.covariance() for robot, _ in drives], axis=0)
    # 300 samples know a variance to 8 %; the worst of six numbers may be three times as far off.
    scale = np.sqrt(np.outer(np.diag(told), np.diag(told)))
    assert np.abs(sampled - told).max() < 0.25 * scale.max()
    assert np.abs((sampled - told) / scale).max() < 0.25
