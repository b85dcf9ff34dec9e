"""One simulated robot: commands in, state out, exact at any instant.

Time enters as a whole number of nanoseconds that never decreases. The robot moves only in
``advance`` and there splits its step where a velocity changes (a command, the end of a ramp, the
timeout), so what it does depends on when commands came, not on how often it is asked.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

from fake_turtlebot_sim.differential_drive import arc, ramp, wheel_rates
from fake_turtlebot_sim.velocity_command import VelocityLimits, between, is_finite, limit, ramp_time


@dataclass(frozen=True)
class RobotModel:
    """Constants of a robot. Defaults: TurtleBot 2 (wheels: kobuki_core; timeout: kobuki_node)."""

    wheel_separation: float = 0.230  # [m]
    wheel_radius: float = 0.035  # [m]
    cmd_vel_timeout: float = 0.6  # [s]
    limits: VelocityLimits = field(default_factory=VelocityLimits)


class RobotState(NamedTuple):
    """The robot at one instant: pose in the odometry frame, executed velocity, wheels."""

    x: float  # [m]
    y: float  # [m]
    yaw: float  # [rad], in (-pi, pi]
    v: float  # [m/s]
    w: float  # [rad/s]
    left_angle: float  # [rad], as are the wheels' angles of a real robot: never wrapped
    right_angle: float  # [rad]
    left_rate: float  # [rad/s]
    right_rate: float  # [rad/s]


class SimulatedRobot:
    """A robot that obeys its newest command until the timeout, then stops."""

    def __init__(self, model, start_pose=(0.0, 0.0, 0.0), time_ns=0):
        """Put the robot at rest at start_pose, (x [m], y [m], yaw [rad])."""
        self._model = model
        self._timeout_ns = round(model.cmd_vel_timeout * 1e9)
        self._time_ns = time_ns
        self._expires_ns = time_ns
        self._velocity = self._target = (0.0, 0.0)
        self._wheels = (0.0, 0.0)
        self._pose = start_pose

    def command(self, velocity, now_ns):
        """Obey the velocity (v [m/s], w [rad/s]) from now on.

        Returns False, and ignores the command, if it is not finite.
        """
        if not is_finite(velocity):
            return False
        self.advance(now_ns)
        self._target = limit(velocity, self._model.limits)
        self._expires_ns = self._time_ns + self._timeout_ns
        return True

    def place(self, pose):
        """Lift the robot to a pose (x [m], y [m], yaw [rad]); its wheels and command stay."""
        self._pose = pose

    def reset(self):
        """Zero the pose and the angles of the wheels, as the Kobuki's reset_odometry does."""
        self._pose = (0.0, 0.0, 0.0)
        self._wheels = (0.0, 0.0)

    def advance(self, to_ns):
        """Move up to the time to_ns; a time already passed changes nothing."""
        if self._time_ns < self._expires_ns <= to_ns:
            self._move(self._expires_ns)
            self._target = (0.0, 0.0)
        if self._time_ns < to_ns:
            self._move(to_ns)

    def state(self):
        """Return the state at the time of the last advance()."""
        rates = self._wheel_rates(self._velocity)
        return RobotState(*self._pose, *self._velocity, *self._wheels, *rates)

    def _wheel_rates(self, velocity):
        return wheel_rates(velocity, self._model.wheel_separation, self._model.wheel_radius)

    def _move(self, to_ns):
        """Move with one target: first the ramp towards it, if any is left, then steadily."""
        dt = (to_ns - self._time_ns) * 1e-9
        self._time_ns = to_ns
        if self._velocity != self._target:
            ramp_s = ramp_time(self._velocity, self._target, self._model.limits)
            if ramp_s > dt:
                self._drive(between(self._velocity, self._target, dt / ramp_s), dt)
                return
            self._drive(self._target, ramp_s)
            self._velocity = self._target
            dt -= ramp_s
        self._drive(self._target, dt)

    def _drive(self, end_velocity, dt):
        """Drive for dt [s] while the velocity changes linearly to end_velocity."""
        if dt == 0.0 or self._velocity == end_velocity == (0.0, 0.0):
            return
        if self._velocity == end_velocity:
            self._pose = arc(self._pose, end_velocity, dt)
        else:
            self._pose = ramp(self._pose, self._velocity, end_velocity, dt)
        left, right = self._wheel_rates(between(self._velocity, end_velocity, 0.5))
        self._wheels = (self._wheels[0] + left * dt, self._wheels[1] + right * dt)
        self._velocity = end_velocity
