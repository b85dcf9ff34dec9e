"""One simulated robot: commands in, state out, exact at any instant.

Time enters as a whole number of nanoseconds that never decreases. The robot moves only in
``advance`` and there splits its step where a velocity changes (a command, the end of a ramp, the
timeout), so what it does depends on when commands came, not on how often it is asked.
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
Change = Tuple[Velocity, Velocity]  # a velocity, linear in time: at its start and at its end


def meet(robots: Sequence[SimulatedRobot], reach: float) -> None:
    """Let each robot meet those within reach [m]: those that it could touch in its next steps."""
    places = np.array([robot.true_pose[:2] for robot in robots])
    away = np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
    np.fill_diagonal(away, np.inf)
    for robot, row in zip(robots, away <= reach):
        robot.company = [robots[k] for k in row.nonzero()[0]]


class CommandResult(Enum):
    """What becomes of a command."""

    ACCEPTED = "obeyed"
    LIMITED = "more than the robot can do; scaled down to what it can"
    REJECTED = "not a finite number; ignored"
    POWERLESS = "its motors are off, by mobile_base/commands/motor_power; ignored"


class RobotState(NamedTuple):
    """The robot at one instant: pose in the odometry frame, executed velocity, wheels."""

    x: float  # [m]
    y: float  # [m]
    yaw: float  # [rad], in (-pi, pi]
    v: float  # [m/s]
    w: float  # [rad/s]
    left_angle: float  # [rad], never wrapped, as a real robot reports it
    right_angle: float  # [rad]
    left_rate: float  # [rad/s]
    right_rate: float  # [rad/s]


class SimulatedRobot:
    """A robot that obeys its newest command until the timeout, if it has one, then stops."""

    def __init__(
        self, parameters: SimulatorParameters, start_pose: Pose = ORIGIN, name: str = ""
    ) -> None:
        """Put the robot at rest at start_pose, (x [m], y [m], yaw [rad]), at the time 0.

        Each name draws odometry noise of its own, in company or alone. The pose is in the frame of
        the SimulatorParameters' world, if there is one, and the odometry starts with it.
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
        # Whether the odometry may differ from the truth.
        self.odometry_differs = self._errors is not None or self._surroundings is not None
        self._contact: float | None = None
        self._dropped = ON_ITS_WHEELS
        self.company: Sequence[SimulatedRobot] = ()  # others that may be in the way
        self._start_pose = start_pose if p.world else ORIGIN
        self.place(start_pose)

    def command(self, velocity: Velocity, now_ns: int) -> CommandResult:
        """Obey the velocity (v [m/s], w [rad/s]) from now on; return the CommandResult on it."""
        if not all(map(isfinite, velocity)):
            return CommandResult.REJECTED  # and the timeout runs on
        if not self._has_power:
            return CommandResult.POWERLESS
        self.advance(now_ns)
        p = self._parameters
        fastest = p.max_linear_speed or FASTEST, p.max_angular_speed or FASTEST
        self._target = limit(velocity, *fastest)
        self._expires_ns = self._time_ns + self._timeout_ns
        return CommandResult.ACCEPTED if self._target == velocity else CommandResult.LIMITED

    def switch_motors(self, is_on: bool, now_ns: int) -> None:
        """Stop and obey nothing while off; what was commanded before does not drive afterwards."""
        self.command(REST, now_ns)
        self._has_power = is_on

    def place(self, pose: Pose) -> None:
        """Lift the robot to a pose (x [m], y [m], yaw [rad]); its wheels and command stay.

        Raises ValueError if something is there, or an edge, or if it is too far away.
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
        """Zero the odometry and the angles of the wheels, as the Kobuki does on request.

        On an empty plane the robot itself is at the origin then, too.
        """
        if self._surroundings is None:
            self.place(ORIGIN)
        else:
            self._pose = ORIGIN
            if self._errors:
                self._errors.forget()
        self._turned_at_reset = self.turned

    def reset(self) -> None:
        """Begin again: in a world at the start, else at the origin, with wheels at zero."""
        self.place(self._start_pose)
        self._turned_at_reset = self.turned

    def advance(self, to_ns: int) -> bool:
        """Move up to to_ns, unless that has passed; return whether the timeout ended a motion."""
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
        """Return the RobotState as an outside observer sees it: without odometry errors."""
        state = self.state()
        x, y, yaw = self.true_pose
        v, w = self._errors.true_velocity(self._velocity) if self._errors else self._velocity
        return state._replace(x=x, y=y, yaw=yaw, v=v, w=w)

    def covariance(self) -> Any:
        """Return how the odometry errs, 3 x 3 for x [m], y [m], yaw [rad]; None without noise."""
        return self._errors.covariance if self._errors and self._errors.wheel_noise else None

    @property
    def true_pose(self) -> Pose:
        """Return where the robot is, (x [m], y [m], yaw [rad])."""
        return self._true_pose if self.odometry_differs else self._pose

    @property
    def contact(self) -> float | None:
        """Return in which direction [rad, ahead is 0] the robot pushes something, or None."""
        return None if self._contact is None else wrap_angle(self._contact - self.true_pose[2])

    @property
    def disc(self) -> Obstacle:
        """Return the robot as others meet it."""
        return (*self.true_pose[:2], *self.true_pose[:2], BASE_RADIUS_M)

    def sensed(self) -> Sensed:
        """Return what the robot's sensors feel at the time of the last advance()."""
        world = self._parameters.world
        if world is None:
            return Sensed()
        return Sensed(bumpers(self.contact), cliffs(self.true_pose, world), self._dropped)

    @property
    def target(self) -> Velocity:
        """Return the velocity (v [m/s], w [rad/s]) that is commanded, within the limits."""
        return self._target

    @property
    def is_driven(self) -> bool:
        """Return whether a command is in force, that is, not timed out."""
        return self._time_ns < self._expires_ns

    @property
    def is_moving(self) -> bool:
        """Return whether the robot had a velocity at the time of the last advance()."""
        return self._velocity != REST

    def _wheel_rates(self, velocity: Velocity) -> tuple[float, float]:
        p = self._parameters
        return wheel_rates(velocity, p.wheel_separation, p.wheel_radius)

    def _move(self, to_ns: int) -> None:
        """Move with one target: first the ramp towards it, if any is left, then steadily."""
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
            self._velocity = REST  # it stays there until it is lifted

    def _drive_in_world(self, around: Surroundings, wheels: Piece, true: Piece) -> None:
        """Drive until something is in the way, or a wheel drops."""
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
            if piece.is_blocked:  # the wheels, too, only turn the robot
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
        """Let the wheels turn for dt [s] as for a velocity, while the robot has the true one."""
        mean = wheels[0] if wheels[0] == wheels[1] else between(*wheels, 0.5)
        if self.odometry_differs:
            self._true_pose = drive(self._true_pose, *true, dt)
        if self._errors and self._errors.wheel_noise and dt:
            # The measured travel of a step carries no more than its mean velocity.
            before, mean = self._pose, self._errors.measured(mean, dt)
            self._pose = drive(before, mean, mean, dt)
            self._errors.grow(before, self._pose, mean, dt)
        else:
            self._pose = drive(self._pose, *wheels, dt)
        left, right = self._wheel_rates(mean)
        self.turned = (self.turned[0] + left * dt, self.turned[1] + right * dt)
