"""Kinematics of a differential drive, exact for any velocity and any step, and its limits.

x points forward, y to the left, yaw grows counter-clockwise (REP-103); metres, radians, seconds.
A constant velocity traces an arc of a circle. The chord of the arc is ``v dt sin(h) / h`` long,
where ``h`` is half the change of yaw, and points along the heading in the middle of the arc.
Unlike the usual formula with the radius v / w, this one stays precise as w goes to zero.
"""

from __future__ import annotations

from math import ceil, cos, inf, pi, remainder, sin, tau
from typing import Tuple

import numpy as np

# Nodes and weights of Gauss-Legendre quadrature on [-1, 1], for ramps, which have no closed form.
_NODES, _WEIGHTS = (
    values.tolist()
    for values in np.polynomial.legendre.leggauss(8)  # type: ignore[no-untyped-call, unused-ignore]
)
Pose = Tuple[float, float, float]  # x [m], y [m], yaw [rad]
Velocity = Tuple[float, float]  # v [m/s], w [rad/s]


def wrap_angle(angle: float) -> float:
    """Return the angle [rad] wrapped into (-pi, pi]."""
    wrapped = remainder(angle, tau)
    return wrapped if wrapped > -pi else pi


def composed(frame: Pose, pose: Pose) -> Pose:
    """Return a pose given in a frame, in the parent of that frame."""
    c, s = cos(frame[2]), sin(frame[2])
    x, y = frame[0] + c * pose[0] - s * pose[1], frame[1] + s * pose[0] + c * pose[1]
    return x, y, frame[2] + pose[2]


def arc(pose: Pose, velocity: Velocity, dt: float) -> Pose:
    """Return the pose after dt [s] at a constant velocity; its yaw is in (-pi, pi]."""
    x, y, yaw = pose
    v, w = velocity
    half_turn = 0.5 * w * dt
    chord = v * dt * (sin(half_turn) / half_turn if half_turn else 1.0)
    heading = yaw + half_turn
    yaw = wrap_angle(heading + half_turn)
    return x + chord * cos(heading), y + chord * sin(heading), yaw


def ramp(pose: Pose, velocity: Velocity, end_velocity: Velocity, dt: float) -> Pose:
    """Return the pose after dt [s] in which the velocity changes linearly to end_velocity.

    Yaw has a closed form. The path has none: it is integrated by Gauss-Legendre quadrature over
    pieces of at most 1 rad, which leaves only rounding errors.
    """
    x, y, yaw = pose
    (v, w), (v_end, w_end) = velocity, end_velocity
    pieces = max(1, ceil(max(abs(w), abs(w_end)) * dt))
    half = 0.5 / pieces  # half a piece, as a share of the ramp
    for piece in range(pieces):
        middle = (2 * piece + 1) * half
        for node, weight in zip(_NODES, _WEIGHTS):
            share = middle + half * node
            heading = yaw + (w + 0.5 * (w_end - w) * share) * share * dt
            step = weight * half * dt * (v + (v_end - v) * share)
            x += step * cos(heading)
            y += step * sin(heading)
    return x, y, wrap_angle(yaw + 0.5 * (w + w_end) * dt)


def drive(pose: Pose, velocity: Velocity, end_velocity: Velocity, dt: float) -> Pose:
    """Return the pose after a drive: arc() if both velocities are equal, otherwise ramp()."""
    if velocity == end_velocity:
        return arc(pose, velocity, dt)
    return ramp(pose, velocity, end_velocity, dt)


def limit(velocity: Velocity, max_linear: float, max_angular: float) -> Velocity:
    """Return the velocity within the limits; both parts scale alike, which keeps the curvature."""
    v, w = velocity
    scale = 1.0
    if abs(v) > max_linear:
        scale = max_linear / abs(v)
    if abs(w) * scale > max_angular:
        scale = max_angular / abs(w)
    return v * scale, w * scale


def ramp_time(
    velocity: Velocity, target: Velocity, linear_acceleration: float, angular_acceleration: float
) -> float:
    """Return the least time [s] from a velocity to the target; an acceleration of 0 is no limit.

    Both parts take the same time, so that the velocity changes along a straight line.
    """
    return max(
        abs(target[0] - velocity[0]) / (linear_acceleration or inf),
        abs(target[1] - velocity[1]) / (angular_acceleration or inf),
    )


def between(velocity: Velocity, target: Velocity, share: float) -> Velocity:
    """Return the velocity at a share (0 to 1) of the way to the target."""
    return (
        velocity[0] + (target[0] - velocity[0]) * share,
        velocity[1] + (target[1] - velocity[1]) * share,
    )


def wheel_rates(
    velocity: Velocity, wheel_separation: float, wheel_radius: float
) -> tuple[float, float]:
    """Return the rates (left, right) [rad/s] of wheels that roll without slipping; lengths [m]."""
    v, w = velocity
    swing = 0.5 * w * wheel_separation
    return (v - swing) / wheel_radius, (v + swing) / wheel_radius
