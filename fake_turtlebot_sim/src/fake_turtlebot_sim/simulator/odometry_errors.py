"""Why a robot is not where its odometry says: unequal wheels, a wrong track, slipping wheels.

The systematic errors are those of UMBmark (Borenstein and Feng, 1996, "Measurement and correction
of systematic odometry errors in mobile robots"): E_d, the ratio of the actual wheel diameters,
right to left, at an unchanged mean, and E_b, the ratio of the actual to the nominal track. They
bend the true path, while the odometry assumes the nominal robot.

The noise is that of Chong and Kleeman (1997, "Accurate odometry and error modelling for a mobile
robot"): the measured travel of each wheel is off by a normal error whose variance grows with the
distance, so its size does not depend on how the way is cut into steps.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from random import Random
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity, wheel_rates


class OdometryErrors:
    """The errors of one robot: what it truly does, what it measures, how far it can be trusted."""

    def __init__(
        self,
        wheel_separation: float,
        wheel_radius_ratio: float = 1.0,
        track_ratio: float = 1.0,
        wheel_noise: float = 0.0,
        seed: str = "",
    ) -> None:
        """Take what SimulatorParameters has under these names; the noise is drawn from the seed."""
        self._separation = wheel_separation
        self._radius_ratio, self._track_ratio = wheel_radius_ratio, track_ratio
        self.wheel_noise = wheel_noise
        self._random = Random(seed)
        self.forget()

    def forget(self) -> None:
        """Trust the odometry fully again, as after the robot was put at a known place."""
        self.covariance: Any = np.zeros((3, 3))  # x [m], y [m], yaw [rad]

    def true_velocity(self, velocity: Velocity) -> Velocity:
        """Return the velocity of the actual robot whose wheels turn as the nominal one's."""
        left, right = wheel_rates(velocity, self._separation, 1.0)
        ratio = self._radius_ratio
        left *= 2.0 / (1.0 + ratio)
        right *= 2.0 * ratio / (1.0 + ratio)
        return 0.5 * (left + right), (right - left) / (self._track_ratio * self._separation)

    def measured(self, velocity: Velocity, dt: float) -> Velocity:
        """Return the mean velocity [m/s, rad/s] that the wheels seem to have had during dt [s]."""
        left, right = (
            rate + self._random.gauss(0.0, self.wheel_noise * sqrt(abs(rate) / dt))
            for rate in wheel_rates(velocity, self._separation, 1.0)
        )
        return 0.5 * (left + right), (right - left) / self._separation

    def grow(self, before: Pose, after: Pose, velocity: Velocity, dt: float) -> None:
        """Let the covariance grow by a step between two measured poses (x, y, yaw).

        The derivatives are those of a step along the heading in its middle.
        """
        middle = before[2] + 0.5 * velocity[1] * dt
        by_pose = np.eye(3)
        by_pose[0, 2], by_pose[1, 2] = before[1] - after[1], after[0] - before[0]
        # How a metre of the left and of the right wheel moves (x, y, yaw).
        aside = 0.5 * velocity[0] * dt / self._separation
        along, across = np.array([cos(middle), sin(middle)]), np.array([-sin(middle), cos(middle)])
        by_wheels = np.empty((3, 2))
        by_wheels[:2, 0] = 0.5 * along - aside * across
        by_wheels[:2, 1] = 0.5 * along + aside * across
        by_wheels[2] = -1.0 / self._separation, 1.0 / self._separation
        distances = np.abs(wheel_rates(velocity, self._separation, 1.0)) * dt
        wheels = self.wheel_noise**2 * distances
        self.covariance = by_pose @ self.covariance @ by_pose.T + (by_wheels * wheels) @ by_wheels.T
