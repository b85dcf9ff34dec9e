"""One simulated robot: takes commands and returns its state, exact at any instant.

Times are whole numbers of nanoseconds that never decrease. The robot moves only in ``advance``,
which splits its step where the velocity changes (a command, the end of a ramp, the timeout). So
its path depends on when commands arrived, not on how often ``advance`` is called.
"""

from __future__ import annotations

from enum import Enum
from math import inf, isfinite
from typing import Any, NamedTuple, Sequence, Tuple

import numpy as np

from fake_turtlebot_sim.simulator.contact import Obstacle, Piece, drive_among
from fake_turtlebot_sim.simulator.differential_drive import (
    Pose,
    Velocity,
    between,
    drive,
    limit,
    ramp_time,
    wheel_rates,
    wrap_angle,
)
from fake_turtlebot_sim.simulator.odometry_errors import OdometryErrors
from fake_turtlebot_sim.simulator.parameters import FASTEST, SimulatorParameters
from fake_turtlebot_sim.simulator.sensors import Sensed, bumpers, cliffs, first_drop
from fake_turtlebot_sim.simulator.world import BASE_RADIUS_M, FARTHEST_PLACE_M, ORIGIN, Surroundings

REST: Velocity = (0.0, 0.0)
ON_ITS_WHEELS = (False, False)
Change = Tuple[Velocity, Velocity]  # the first and the last velocity of a linear change


def meet(robots: Sequence[SimulatedRobot], reach: float) -> None:
    """Let each robot meet the robots within reach [m], which it could touch in its next steps."""
    places = np.array([robot.true_pose[:2] for robot in robots])
    away = np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
    np.fill_diagonal(away, np.inf)
    for robot, row in zip(robots, away <= reach):
        robot.company = [robots[k] for k in row.nonzero()[0]]


class CommandResult(Enum):
    """What the robot does with a command."""

    ACCEPTED = "obeyed"
    LIMITED = "faster than the robot can drive; scaled down to its limits"
    REJECTED = "not a finite number; ignored"
    POWERLESS = "its motors are off, by mobile_base/commands/motor_power; ignored"


class RobotState(NamedTuple):
    """The robot at one instant: pose in the odometry frame, executed velocity, wheels."""

    x: float  # [m]
    y: float  # [m]
    yaw: float  # [rad], in (-pi, pi]
    v: float  # [m/s]
    w: float  # [rad/s]
    left_angle: float  # [rad], never wrapped, as on a real robot
    right_angle: float  # [rad]
    left_rate: float  # [rad/s]
    right_rate: float  # [rad/s]


class SimulatedRobot:
    """A robot that obeys its newest command until the timeout, if there is one, and then stops."""

    def __init__(
        self, parameters: SimulatorParameters, start_pose: Pose = ORIGIN, name: str = ""
    ) -> None:
        """Put the robot at rest at start_pose, (x [m], y [m], yaw [rad]), at the time 0.

        Each name has odometry noise of its own. The pose is in the frame of the world, if there is
        one, and the odometry starts there.
        """
        p = self._parameters = parameters
        self._timeout_ns = round(p.cmd_vel_timeout * 1e9) if p.cmd_vel_timeout else inf
        self._time_ns = 0
        self._expires_ns: float = 0
        self._velocity = self._target = REST
        self.turned = self._turned_at_reset = (0.0, 0.0)  # left, right [rad], since the start
        self._has_power = True
        errors = (p.wheel_radius_ratio, p.track_ratio, p.wheel_noise)
        self._errors = None
        if errors != (1.0, 1.0, 0.0):
            self._errors = OdometryErrors(p.wheel_separation, *errors, f"{p.seed}/{name}")
        self._surroundings = Surroundings(p.world) if p.world else None
        # Whether the odometry may differ from the true pose.
        self.odometry_differs = self._errors is not None or self._surroundings is not None
        self._contact: float | None = None
        self._dropped = ON_ITS_WHEELS
        self.company: Sequence[SimulatedRobot] = ()  # other robots that may be in the way
        self._start_pose = start_pose if p.world else ORIGIN
        self.place(start_pose)

    def command(self, velocity: Velocity, now_ns: int) -> CommandResult:
        """Obey the velocity (v [m/s], w [rad/s]) from now on; return the CommandResult."""
        if not all(map(isfinite, velocity)):
            return CommandResult.REJECTED  # without restarting the timeout
        if not self._has_power:
            return CommandResult.POWERLESS
        self.advance(now_ns)
        p = self._parameters
        fastest = p.max_linear_speed or FASTEST, p.max_angular_speed or FASTEST
        self._target = limit(velocity, *fastest)
        self._expires_ns = self._time_ns + self._timeout_ns
        return CommandResult.ACCEPTED if self._target == velocity else CommandResult.LIMITED

    def switch_motors(self, is_on: bool, now_ns: int) -> None:
        """Stop, and obey no command while the motors are off; earlier commands never resume."""
        self.command(REST, now_ns)
        self._has_power = is_on

    def place(self, pose: Pose) -> None:
        """Lift the robot to a pose (x [m], y [m], yaw [rad]); wheel angles and command stay.

        Raises ValueError if an obstacle or an edge is there, or if the pose is too far away.
        """
        if not max(map(abs, pose[:2])) <= FARTHEST_PLACE_M:
            raise ValueError(f"a pose is at most {FARTHEST_PLACE_M:g} m from (0, 0)")
        if self._parameters.world:
            self._parameters.world.check_place(pose)
        x, y, yaw = pose
        self._pose = self._true_pose = (x, y, wrap_angle(yaw))
        self._contact, self._dropped = None, ON_ITS_WHEELS
        if self._errors:
            self._errors.forget()

    def reset_odometry(self) -> None:
        """Zero the odometry and the wheel angles, as the Kobuki does on request.

        On an empty plane this moves the robot itself to the origin, too.
        """
        if self._surroundings is None:
            self.place(ORIGIN)
        else:
            self._pose = ORIGIN
            if self._errors:
                self._errors.forget()
        self._turned_at_reset = self.turned

    def reset(self) -> None:
        """Return to the start of the world, or to the origin without one; zero the wheel angles."""
        self.place(self._start_pose)
        self._turned_at_reset = self.turned

    def advance(self, to_ns: int) -> bool:
        """Move until to_ns, unless it has passed; return whether the timeout ended a motion."""
        has_timed_out = False
        if self._time_ns < self._expires_ns <= to_ns:
            self._move(int(self._expires_ns))
            has_timed_out = self._target != REST
            self._target = REST
        if self._time_ns <= to_ns:
            self._move(to_ns)
        return has_timed_out

    def state(self) -> RobotState:
        """Return the RobotState at the time of the last advance()."""
        rates = self._wheel_rates(self._velocity)
        (left, right), zero = self.turned, self._turned_at_reset
        return RobotState(*self._pose, *self._velocity, left - zero[0], right - zero[1], *rates)

    def true_state(self) -> RobotState:
        """Return the true RobotState, without odometry errors."""
        state = self.state()
        x, y, yaw = self.true_pose
        v, w = self._errors.true_velocity(self._velocity) if self._errors else self._velocity
        return state._replace(x=x, y=y, yaw=yaw, v=v, w=w)

    def covariance(self) -> Any:
        """Return the 3 x 3 covariance of x [m], y [m], yaw [rad]; None without noise."""
        return self._errors.covariance if self._errors and self._errors.wheel_noise else None

    @property
    def true_pose(self) -> Pose:
        """Return the true pose (x [m], y [m], yaw [rad])."""
        return self._true_pose if self.odometry_differs else self._pose

    @property
    def contact(self) -> float | None:
        """Return the direction [rad, 0 is ahead] in which the robot pushes an obstacle, or None."""
        return None if self._contact is None else wrap_angle(self._contact - self.true_pose[2])

    @property
    def disc(self) -> Obstacle:
        """Return the robot as an obstacle for others."""
        return (*self.true_pose[:2], *self.true_pose[:2], BASE_RADIUS_M)

    def sensed(self) -> Sensed:
        """Return the states of the sensors at the time of the last advance()."""
        world = self._parameters.world
        if world is None:
            return Sensed()
        return Sensed(bumpers(self.contact), cliffs(self.true_pose, world), self._dropped)

    @property
    def target(self) -> Velocity:
        """Return the commanded velocity (v [m/s], w [rad/s]), within the limits."""
        return self._target

    @property
    def is_commanded(self) -> bool:
        """Return whether the last command has not expired yet."""
        return self._time_ns < self._expires_ns

    @property
    def is_moving(self) -> bool:
        """Return whether the robot had a velocity at the time of the last advance()."""
        return self._velocity != REST

    def _wheel_rates(self, velocity: Velocity) -> tuple[float, float]:
        p = self._parameters
        return wheel_rates(velocity, p.wheel_separation, p.wheel_radius)

    def _move(self, to_ns: int) -> None:
        """Move with a constant target: ramp up to it, then drive steadily."""
        dt = (to_ns - self._time_ns) * 1e-9
        self._time_ns = to_ns
        if self._velocity != self._target:
            p = self._parameters
            limits = p.max_linear_acceleration, p.max_angular_acceleration
            ramp_s = ramp_time(self._velocity, self._target, *limits)
            if ramp_s > dt:
                self._drive(between(self._velocity, self._target, dt / ramp_s), dt)
                return
            self._drive(self._target, ramp_s)
            self._velocity = self._target
            dt -= ramp_s
        self._drive(self._target, dt)

    def _drive(self, end_velocity: Velocity, dt: float) -> None:
        """Drive for dt [s] while the velocity changes linearly to end_velocity."""
        if dt == 0.0 or self._velocity == end_velocity == REST:
            return
        wheels = true = self._velocity, end_velocity
        self._velocity = end_velocity
        if self._errors:
            true = self._errors.true_velocity(wheels[0]), self._errors.true_velocity(end_velocity)
        if self._surroundings is None:
            self._roll(wheels, true, dt)
        elif not any(self._dropped):
            self._drive_in_world(self._surroundings, Piece(*wheels, dt), Piece(*true, dt))
        else:
            self._velocity = REST  # the robot stays there until it is lifted

    def _drive_in_world(self, around: Surroundings, wheels: Piece, true: Piece) -> None:
        """Drive until an obstacle is in the way or a wheel drops."""
        x, y, _ = self.true_pose
        reach = BASE_RADIUS_M + true.dt * max(abs(true.velocity[0]), abs(true.end_velocity[0]))
        near = around.near(x, y, reach)
        if self.company:
            near = [*near, *(robot.disc for robot in self.company)]
        pieces, self._contact = drive_among(self.true_pose, true, BASE_RADIUS_M, near)
        separation, after = self._parameters.wheel_separation, 0.0
        for piece in pieces:
            turned = wheels[:2]
            if len(pieces) > 1:
                turned = wheels.until(after)[1], wheels.until(after + piece.dt)[1]
                after += piece.dt
            if piece.is_blocked:  # the wheels only turn the robot, too
                turned = (0.0, turned[0][1]), (0.0, turned[1][1])
            drop = first_drop(self.true_pose, piece, separation, around.world.edges)
            if drop is not None:
                dt, self._dropped = drop
                turned = Piece(*turned, piece.dt).until(dt)[:2]
                self._roll(turned, piece.until(dt)[:2], dt)
                self._velocity, self._contact = REST, None
                return
            self._roll(turned, piece[:2], piece.dt)
        if self._contact is not None:
            self._velocity = 0.0, wheels.end_velocity[1]

    def _roll(self, wheels: Change, true: Change, dt: float) -> None:
        """Turn the wheels for dt [s] by one velocity, and move the robot by the true one."""
        mean = wheels[0] if wheels[0] == wheels[1] else between(*wheels, 0.5)
        if self.odometry_differs:
            self._true_pose = drive(self._true_pose, *true, dt)
        if self._errors and self._errors.wheel_noise and dt:
            # The measured travel of a step yields only its mean velocity.
            before, mean = self._pose, self._errors.measured(mean, dt)
            self._pose = drive(before, mean, mean, dt)
            self._errors.grow(before, self._pose, mean, dt)
        else:
            self._pose = drive(self._pose, *wheels, dt)
        left, right = self._wheel_rates(mean)
        self.turned = (self.turned[0] + left * dt, self.turned[1] + right * dt)
