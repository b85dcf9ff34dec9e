"""Which velocity the wheels get: the newest command, until it expires."""

from __future__ import annotations

from enum import Enum
from math import isfinite

from kobuki_protocol.base_control import Velocity

ZERO: Velocity = (0.0, 0.0)
# kobuki_driver's acceleration_limiter.hpp: faster by at most [m/s2, rad/s2], slower by 1.2 times.
MOST_ACCELERATION = (0.5, 3.5)
SLOWING = 1.2
LONGEST_STEP_S = 0.1  # of the limiter, after a gap


class VelocityResult(Enum):
    """What becomes of a command."""

    OBEYED = "obeyed"
    NOT_FINITE = "a velocity is not a finite number; ignored"
    POWERLESS = "the motors are off, by commands/motor_power; velocities are ignored"
    OFFLINE = "the Kobuki is offline; velocities are ignored until it is back"


class VelocityControl:
    """Obeys the newest velocity. Times are in seconds of one clock that never jumps."""

    def __init__(self, timeout_s: float, is_limited: bool = False) -> None:
        """Begin at rest; is_limited: velocities change gradually, but for what stops the robot."""
        self._timeout_s, self._is_limited = timeout_s, is_limited
        self._target = ZERO
        self._executed = ZERO  # what the wheels have got
        self._commanded_s = self._stepped_s = 0.0
        self.has_power = True
        self.is_online = False

    def command(self, velocity: Velocity, now_s: float) -> VelocityResult:
        """Obey a velocity (v [m/s], w [rad/s]) from now on."""
        if not all(map(isfinite, velocity)):
            return VelocityResult.NOT_FINITE  # and the timeout runs on
        if not self.is_online:
            return VelocityResult.OFFLINE
        if not self.has_power:
            return VelocityResult.POWERLESS
        self._target, self._commanded_s = velocity, now_s
        return VelocityResult.OBEYED

    def stop(self) -> None:
        """Stand until the next command."""
        self._target = self._executed = ZERO

    def switch_motors(self, is_on: bool) -> None:
        """Stop and obey nothing while off; what was commanded before does not drive afterwards."""
        self.stop()
        self.has_power = is_on

    def switch_robot(self, is_online: bool) -> None:
        """Take it that the robot was lost, or is back: it stands until the next command."""
        self.stop()
        self.is_online = is_online

    def expires(self, now_s: float) -> bool:
        """Return whether a motion has just ended, as no command came in time."""
        if self._target == ZERO or now_s - self._commanded_s < self._timeout_s:
            return False
        self.stop()
        return True

    def velocity(self, now_s: float) -> Velocity:
        """Return what the wheels are to do now."""
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
    """Return the value after a step, up to 1.2 times as long where it falls."""
    return min(now + step, max(now - SLOWING * step, target))
