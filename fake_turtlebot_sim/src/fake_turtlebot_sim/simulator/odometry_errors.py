"""The errors of odometry: unequal wheels, a wrong track, and slipping wheels.

The systematic errors are those of UMBmark (Borenstein and Feng, 1996, "Measurement and correction
of systematic odometry errors in mobile robots"): E_d, the ratio of the actual wheel diameters,
right to left, at an unchanged mean, and E_b, the ratio of the actual to the nominal track. They
bend the true path, while the odometry assumes the nominal robot.

The noise is that of Chong and Kleeman (1997, "Accurate odometry and error modelling for a mobile
robot"): the measured travel of each wheel has a normal error whose variance grows with the
distance, so that it does not depend on how the path is cut into steps.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from random import Random
from typing import Any

import numpy as np

from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity, wheel_rates


class OdometryErrors:
    """One robot's true velocity, its measurement, and the covariance of its odometry."""

    def __init__(
        self,
        wheel_separation: float,
        wheel_radius_ratio: float = 1.0,
        track_ratio: float = 1.0,
        wheel_noise: float = 0.0,
        seed: str = "",
    ) -> None:
        """Take parameters of the simulator; the seed determines the noise."""
        self._separation = wheel_separation
        self._radius_ratio, self._track_ratio = wheel_radius_ratio, track_ratio
        self.wheel_noise = wheel_noise
        self._random = Random(seed)
        self.forget()

    def forget(self) -> None:
        """Reset the covariance to zero, as after the robot was put at a known pose."""
        self.covariance: Any = np.zeros((3, 3))  # x [m], y [m], yaw [rad]

    def true_velocity(self, velocity: Velocity) -> Velocity:
        """Return the velocity of the actual robot when its wheels turn like the nominal robot's."""
        left, right = wheel_rates(velocity, self._separation, 1.0)
        ratio = self._radius_ratio
        left *= 2.0 / (1.0 + ratio)
        right *= 2.0 * ratio / (1.0 + ratio)
        return 0.5 * (left + right), (right - left) / (self._track_ratio * self._separation)

    def measured(self, velocity: Velocity, dt: float) -> Velocity:
        """Return the mean velocity [m/s, rad/s] that the wheels measure over dt [s]."""
        left, right = (
            rate + self._random.gauss(0.0, self.wheel_noise * sqrt(abs(rate) / dt))
            for rate in wheel_rates(velocity, self._separation, 1.0)
        )
        return 0.5 * (left + right), (right - left) / self._separation

    def grow(self, before: Pose, after: Pose, velocity: Velocity, dt: float) -> None:
        """Grow the covariance by a step between two measured poses (x, y, yaw).

        The derivatives are those of a step along its middle heading.
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
