"""One turtle: where it is, its pen, and how commands and services change them (pure)."""

from __future__ import annotations

import math
from typing import Tuple

FIELD_M = 499 / 45  # upstream's window of 500 pixels, at 45 pixels a metre
COMMAND_S = 1.0  # a velocity lasts so long

Point = Tuple[float, float]  # (x, y) [m], from the lower left corner
Color = Tuple[int, int, int]  # (r, g, b), each 0 to 255


class Turtle:
    """A turtle at a place and theta [rad]. Services and their fields are named as upstream's."""

    color: Color = (179, 184, 255)  # of the pen, as upstream's
    width, is_down = 3, True  # [pixels], whether it draws
    seen: Color  # where it is, before it draws there, as upstream's sensor

    def __init__(self, x: float, y: float, theta: float, now_s: float) -> None:
        """Stand there, with the pen down."""
        self.place, self.theta = (x, y), theta
        self.velocity = (0.0, 0.0, 0.0)  # ahead, to the left [m/s], turn [rad/s]
        self._time_s = self._until_s = now_s  # when it was there, and when its command ends

    def command(self, ahead: float, left: float, turn: float) -> None:
        """Obey velocities [m/s, m/s, rad/s] from now on, for COMMAND_S."""
        self.velocity, self._until_s = (ahead, left, turn), self._time_s + COMMAND_S

    def advance(self, now_s: float) -> None:
        """Drive until now, on an exact arc; walls are not looked at."""
        ahead, left, turn = self.velocity
        dt_s = max(0.0, min(now_s, self._until_s) - self._time_s)
        half = turn * dt_s / 2
        chord = dt_s * (math.sin(half) / half if half else 1.0)  # [m] at 1 m/s
        cos, sin = math.cos(self.theta + half), math.sin(self.theta + half)
        self._go(chord * (ahead * cos - left * sin), chord * (ahead * sin + left * cos))
        self.theta = math.remainder(self.theta + turn * dt_s, math.tau)
        self._time_s = now_s
        if now_s >= self._until_s:
            self.velocity = (0.0, 0.0, 0.0)

    def _go(self, dx: float, dy: float) -> None:
        x, y = self.place
        self.place = x + dx, y + dy

    def teleport_absolute(self, x: float, y: float, theta: float) -> None:
        """Be elsewhere at once; as upstream's, only y is bounded here, and only above."""
        self.place, self.theta = (x, min(y, FIELD_M)), theta

    def teleport_relative(self, linear: float, angular: float) -> None:
        """Turn [rad], then go straight on [m], both at once."""
        self.theta += angular
        self._go(linear * math.cos(self.theta), linear * math.sin(self.theta))

    def set_pen(self, r: int, g: int, b: int, width: int, off: int) -> None:
        """Lift the pen and leave it as it is, or put down one of a color and width [pixels]."""
        self.is_down = not off
        if not off:
            self.color, self.width = (r, g, b), width or 1

    def clamp(self) -> Point | None:
        """Return to the field; return where it was outside, with y from the top as upstream."""
        x, y = self.place
        self.place = min(max(x, 0.0), FIELD_M), min(max(y, 0.0), FIELD_M)
        return None if (x, y) == self.place else (x, FIELD_M - y)

    @property
    def pose(self) -> tuple[float, float, float, float, float]:
        """The values of turtlesim/Pose. As upstream's, the linear velocity has no sign: a mimic of
        a turtle that drives backwards drives forwards.
        """
        ahead, left, turn = self.velocity
        return (*self.place, self.theta, math.hypot(ahead, left), turn)
