"""The pose of a Kobuki, from its encoders and its gyro."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, remainder, sin, tau

from kobuki_protocol.base_control import WHEEL_RADIUS_M, WHEEL_SEPARATION_M
from kobuki_protocol.feedback import Core, Inertia
from kobuki_protocol.robot_clock import RobotClock

RAD_PER_TICK = 0.002436916871363930187454  # of a wheel: 52 ticks, gears of 49.5833 to 1
WRAP = 1 << 16  # time stamp and encoders have 16 bits
FASTEST_M_PER_S = 1.5  # of a wheel, twice a Kobuki's 0.7 m/s; more means a restarted count
MOST_SLACK_M = 0.02  # tolerated in addition


@dataclass
class OdometryState:
    """The pose and velocity of the robot, and the angles and rates of its wheels."""

    x: float = 0.0  # [m]
    y: float = 0.0
    yaw: float = 0.0  # [rad]
    v: float = 0.0  # [m/s]
    w: float = 0.0  # [rad/s]
    left_angle: float = 0.0  # [rad] of a wheel
    right_angle: float = 0.0
    left_rate: float = 0.0  # [rad/s]
    right_rate: float = 0.0


class Odometry:
    """Computes the state from a Kobuki's packets.

    Only differences count: a robot that was switched off and on starts with other counts, and the
    pose stays. While the cable is out the robot keeps counting, so no part of the pose is lost.
    """

    def __init__(self, uses_gyro: bool = True) -> None:
        """Start at the origin; uses_gyro: take the heading from the gyro, not from the wheels."""
        self._uses_gyro = uses_gyro
        self._clock = RobotClock()
        self._core = Core()
        self._time_s = 0.0  # time of the last packet
        self._gyro_zero = 0.0  # the gyro's angle at yaw 0 [rad]
        self.gyro_heading = 0.0  # [rad], even if the yaw is that of the wheels
        self.counts = 0  # one, and one more for each restart of the robot
        self.state = OdometryState()

    @property
    def late_s(self) -> float:
        """Return the delay [s] of the last packet, in a port or on the way."""
        return self._clock.late_s

    def update(self, core: Core, inertia: Inertia, now_s: float) -> OdometryState:
        """Return the state after a packet that came at now_s, of a clock that never jumps."""
        last, self._core = self._core, core
        waited_s, self._time_s = now_s - self._time_s, now_s
        left = signed(core.left_encoder - last.left_encoder) * RAD_PER_TICK
        right = signed(core.right_encoder - last.right_encoder) * RAD_PER_TICK
        dt = self._clock.elapsed_s(core.time_stamp, now_s)
        if dt is None or is_too_far(max(abs(left), abs(right)) * WHEEL_RADIUS_M, dt):
            self.counts += 1
            self._gyro_zero = wrapped(inertia.heading - self.gyro_heading)
            self.rest()
            return self.state
        self._move(left, right, inertia)
        if dt > 0.0:
            self._measure(left, right, inertia, dt if waited_s < 1.0 else max(dt, waited_s))
        return self.state

    def _measure(self, left: float, right: float, inertia: Inertia, dt: float) -> None:
        state = self.state
        state.left_rate, state.right_rate = left / dt, right / dt
        state.v = 0.5 * (left + right) * WHEEL_RADIUS_M / dt
        turn = (right - left) * WHEEL_RADIUS_M / WHEEL_SEPARATION_M
        state.w = inertia.turn_rate if self._uses_gyro else turn / dt

    def _move(self, left: float, right: float, inertia: Inertia) -> None:
        state = self.state
        state.left_angle += left
        state.right_angle += right
        travel = 0.5 * (left + right) * WHEEL_RADIUS_M
        heading = wrapped(inertia.heading - self._gyro_zero)
        turn = wrapped(heading - self.gyro_heading)
        self.gyro_heading = heading
        if not self._uses_gyro:
            turn = (right - left) * WHEEL_RADIUS_M / WHEEL_SEPARATION_M
        half = 0.5 * turn
        chord = travel * (sin(half) / half if half else 1.0)  # of the arc between the packets
        state.x += chord * cos(state.yaw + half)
        state.y += chord * sin(state.yaw + half)
        state.yaw = heading if self._uses_gyro else wrapped(state.yaw + turn)

    def rest(self) -> None:
        """Set all velocities to zero, when no more packets come."""
        state = self.state
        state.v = state.w = state.left_rate = state.right_rate = 0.0

    def reset(self) -> None:
        """Return to the origin, and zero the heading and the wheel angles."""
        self._gyro_zero = wrapped(self._gyro_zero + self.gyro_heading)
        self.gyro_heading = 0.0
        self.state = OdometryState(v=self.state.v, w=self.state.w)


def is_too_far(travel_m: float, dt: float) -> bool:
    """Return whether a wheel cannot have travelled so far in dt [s]: its count was restarted."""
    return travel_m > FASTEST_M_PER_S * dt + MOST_SLACK_M


def signed(ticks: int) -> int:
    """Return the difference of two 16-bit counters with the smaller absolute value."""
    return (ticks + WRAP // 2) % WRAP - WRAP // 2


def wrapped(angle: float) -> float:
    """Return the angle [rad] wrapped into (-pi, pi]."""
    turned = remainder(angle, tau)
    return turned if turned > -pi else pi
