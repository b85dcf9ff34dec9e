"""From the encoders and the gyro of a Kobuki to its pose."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, remainder, sin, tau

from kobuki_protocol.base_control import WHEEL_RADIUS_M, WHEEL_SEPARATION_M
from kobuki_protocol.feedback import Core, Inertia
from kobuki_protocol.robot_clock import RobotClock

RAD_PER_TICK = 0.002436916871363930187454  # of a wheel: 52 ticks by gears of 49.5833 to 1
WRAP = 1 << 16  # time stamp and encoders have 16 bits
FASTEST_M_PER_S = 1.5  # of a wheel: twice a Kobuki's 0.7 m/s; more is another count, no travel
MOST_SLACK_M = 0.02  # travel beyond that


@dataclass
class OdometryState:
    """Where the robot is, how it moves, and how far its wheels have turned."""

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
    """Follows a Kobuki's packets.

    Only differences count: a robot that was switched off and on begins with other counts, and the
    pose stays. A cable that was out costs nothing of the pose as long as the robot kept counting.
    """

    def __init__(self, uses_gyro: bool = True) -> None:
        """Begin at the origin; uses_gyro: take the heading from it, not from the wheels."""
        self._uses_gyro = uses_gyro
        self._clock = RobotClock()
        self._core = Core()
        self._time_s = 0.0  # of the last packet
        self._gyro_zero = 0.0  # the gyro's angle where the yaw is 0 [rad]
        self.gyro_heading = 0.0  # [rad], whichever the yaw is taken from
        self.counts = 0  # the first, and one for each restart of the robot
        self.state = OdometryState()

    @property
    def late_s(self) -> float:
        """Return by how much the last packet was late: it waited in a port, or on the way."""
        return self._clock.late_s

    def update(self, core: Core, inertia: Inertia, now_s: float) -> OdometryState:
        """Take a packet that came at now_s, of a clock that never jumps; return the state."""
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
        """Take it that the robot stands: its packets have ceased."""
        state = self.state
        state.v = state.w = state.left_rate = state.right_rate = 0.0

    def reset(self) -> None:
        """Begin again at the origin, heading and wheels included."""
        self._gyro_zero = wrapped(self._gyro_zero + self.gyro_heading)
        self.gyro_heading = 0.0
        self.state = OdometryState(v=self.state.v, w=self.state.w)


def is_too_far(travel_m: float, dt: float) -> bool:
    """Return whether a wheel cannot have travelled so far in dt [s]: it has another count."""
    return travel_m > FASTEST_M_PER_S * dt + MOST_SLACK_M


def signed(ticks: int) -> int:
    """Return a difference of two counters of 16 bits, the shorter way round."""
    return (ticks + WRAP // 2) % WRAP - WRAP // 2


def wrapped(angle: float) -> float:
    """Return the angle [rad] turned by whole circles into (-pi, pi]."""
    turned = remainder(angle, tau)
    return turned if turned > -pi else pi
