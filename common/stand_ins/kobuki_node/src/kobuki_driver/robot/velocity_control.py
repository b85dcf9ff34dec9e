"""The velocity for the wheels: that of the newest command, until it expires."""

from __future__ import annotations

from enum import Enum
from math import isfinite

from kobuki_protocol.base_control import Velocity

ZERO: Velocity = (0.0, 0.0)
# kobuki_driver's acceleration_limiter.hpp: velocities rise by at most this [m/s2, rad/s2], and fall
# by SLOWING times this.
MOST_ACCELERATION = (0.5, 3.5)
SLOWING = 1.2
LONGEST_STEP_S = 0.1  # of the limiter, after a gap


class VelocityResult(Enum):
    """What the driver does with a velocity command."""

    OBEYED = "obeyed"
    NOT_FINITE = "a velocity is not a finite number; ignored"
    POWERLESS = "the motors are off, by commands/motor_power; velocities are ignored"
    OFFLINE = "the Kobuki is offline; velocities are ignored until it is back"


class VelocityControl:
    """Obeys the newest velocity. Times are in seconds of a clock that never jumps."""

    def __init__(self, timeout_s: float, is_limited: bool = False) -> None:
        """Start at rest; is_limited: velocities change gradually, except for stop()."""
        self._timeout_s, self._is_limited = timeout_s, is_limited
        self._target = ZERO
        self._executed = ZERO  # the last velocity for the wheels
        self._commanded_s = self._stepped_s = 0.0
        self.has_power = True
        self.is_online = False

    def command(self, velocity: Velocity, now_s: float) -> VelocityResult:
        """Obey a velocity (v [m/s], w [rad/s]) from now on."""
        if not all(map(isfinite, velocity)):
            return VelocityResult.NOT_FINITE  # without restarting the timeout
        if not self.is_online:
            return VelocityResult.OFFLINE
        if not self.has_power:
            return VelocityResult.POWERLESS
        self._target, self._commanded_s = velocity, now_s
        return VelocityResult.OBEYED

    def stop(self) -> None:
        """Stop until the next command."""
        self._target = self._executed = ZERO

    def switch_motors(self, is_on: bool) -> None:
        """Stop, and obey no command while the motors are off; earlier commands never resume."""
        self.stop()
        self.has_power = is_on

    def switch_robot(self, is_online: bool) -> None:
        """Record that the robot was lost or is back; it stops until the next command."""
        self.stop()
        self.is_online = is_online

    def expires(self, now_s: float) -> bool:
        """Return whether a motion has just ended because no command came in time."""
        if self._target == ZERO or now_s - self._commanded_s < self._timeout_s:
            return False
        self.stop()
        return True

    def velocity(self, now_s: float) -> Velocity:
        """Return the velocity for the wheels now."""
        self.expires(now_s)
        dt, self._stepped_s = min(now_s - self._stepped_s, LONGEST_STEP_S), now_s
        if not self._is_limited:
            self._executed = self._target
        else:
            v, w = (
                _towards(now, target, most * dt)
                for now, target, most in zip(self._executed, self._target, MOST_ACCELERATION)
            )
            self._executed = v, w
        return self._executed


def _towards(now: float, target: float, step: float) -> float:
    """Return the value after a step towards the target; a step down is SLOWING times as long."""
    return min(now + step, max(now - SLOWING * step, target))
