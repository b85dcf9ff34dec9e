"""Velocity commands: which are accepted, how they are limited, how fast they are reached.

All velocities are pairs (v, w): forward [m/s] and counter-clockwise [rad/s].
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import inf, isfinite, pi

from fake_turtlebot_sim.simulator.differential_drive import Velocity


class Verdict(Enum):
    """What becomes of a command."""

    ACCEPTED = "obeyed"
    LIMITED = "more than the robot can do; scaled down to what it can"
    REJECTED = "not a finite number; ignored"


@dataclass(frozen=True)
class VelocityLimits:
    """What the base can do. Defaults: the maximum speeds in the Kobuki's specifications."""

    linear: float = 0.7  # [m/s]
    angular: float = pi  # [rad/s], 180 deg/s
    linear_acceleration: float = inf  # [m/s2]
    angular_acceleration: float = inf  # [rad/s2]


def is_finite(velocity: Velocity) -> bool:
    """Return whether both parts are finite; a NaN or an infinity is no command at all."""
    return all(map(isfinite, velocity))


def limit(velocity: Velocity, limits: VelocityLimits) -> Velocity:
    """Return the velocity within the limits, both parts scaled alike: the curvature is kept."""
    v, w = velocity
    scale = 1.0
    if abs(v) > limits.linear:
        scale = limits.linear / abs(v)
    if abs(w) * scale > limits.angular:
        scale = limits.angular / abs(w)
    return v * scale, w * scale


def ramp_time(velocity: Velocity, target: Velocity, limits: VelocityLimits) -> float:
    """Return the least time [s] in which the limits let the velocity become the target.

    Both parts take the same time, so the velocity goes straight from the one to the other.
    """
    return max(
        abs(target[0] - velocity[0]) / limits.linear_acceleration,
        abs(target[1] - velocity[1]) / limits.angular_acceleration,
    )


def between(velocity: Velocity, target: Velocity, share: float) -> Velocity:
    """Return the velocity that is the share (0 to 1) of the way to the target."""
    return (
        velocity[0] + (target[0] - velocity[0]) * share,
        velocity[1] + (target[1] - velocity[1]) * share,
    )
