"""One turtle: where it is, and how commands and teleports move it (pure)."""

from __future__ import annotations

import math
from typing import NamedTuple, Tuple

FIELD_M = 499 / 45  # upstream's window of 500 pixels, at 45 pixels a metre
COMMAND_S = 1.0  # a velocity lasts so long
LARGEST = 1e38  # messages hold float32

Point = Tuple[float, float]  # (x, y) [m], from the lower left corner
Color = Tuple[int, int, int]  # (r, g, b), each 0 to 255


def check_numbers(*values: float) -> None:
    """Raise ValueError unless all values are finite and fit a message."""
    for value in values:
        if not abs(value) <= LARGEST:
            raise ValueError(f"{value} is no length, angle or velocity of a turtle")


def normalized(theta: float) -> float:
    """Return an angle [rad] as the same one in [-pi, pi)."""
    return theta - 2 * math.pi * math.floor((theta + math.pi) / (2 * math.pi))


class Pen(NamedTuple):
    """What a turtle draws with; these are upstream's."""

    color: Color = (179, 184, 255)
    width: int = 3  # [pixels]
    is_on: bool = True


class Turtle:
    """A turtle at (x, y) [m] and theta [rad]."""

    def __init__(self, x: float, y: float, theta: float, now_s: float) -> None:
        """Stand there, with the pen down."""
        check_numbers(x, y, theta)
        self.x, self.y, self.theta, self.pen = x, y, theta, Pen()
        self.velocity = (0.0, 0.0, 0.0)  # ahead, to the left [m/s], turn [rad/s]
        self.drawn: Point = (x, y)  # the end of its line
        self._time_s = self._until_s = now_s  # when it was there, and when its command ends

    def command(self, ahead: float, left: float, turn: float, now_s: float) -> None:
        """Obey velocities [m/s, m/s, rad/s] from now on, for COMMAND_S."""
        check_numbers(ahead, left, turn)
        self.advance(now_s)
        self.velocity, self._until_s = (ahead, left, turn), now_s + COMMAND_S

    def advance(self, now_s: float) -> None:
        """Drive until now, on an exact arc; walls are not looked at."""
        ahead, left, turn = self.velocity
        dt_s = max(0.0, min(now_s, self._until_s) - self._time_s)
        half = turn * dt_s / 2
        chord = dt_s * (math.sin(half) / half if half else 1.0)  # [m] at 1 m/s
        cos, sin = math.cos(self.theta + half), math.sin(self.theta + half)
        self.x += chord * (ahead * cos - left * sin)
        self.y += chord * (ahead * sin + left * cos)
        self.theta = normalized(self.theta + turn * dt_s)
        self._time_s = now_s
        if now_s >= self._until_s:
            self.velocity = (0.0, 0.0, 0.0)

    def jump_to(self, x: float, y: float, theta: float) -> None:
        """Be elsewhere at once; as upstream's, only y is bounded here, and only above."""
        check_numbers(x, y, theta)
        self.x, self.y, self.theta = x, min(y, FIELD_M), theta

    def jump_by(self, linear: float, angular: float) -> None:
        """Turn [rad], then go straight on [m], both at once."""
        check_numbers(linear, angular)
        self.theta += angular
        self.x += linear * math.cos(self.theta)
        self.y += linear * math.sin(self.theta)

    def clamp(self) -> Point | None:
        """Return to the field; return where it was outside, with y from the top as upstream."""
        x, y = self.x, self.y
        self.x, self.y = min(max(x, 0.0), FIELD_M), min(max(y, 0.0), FIELD_M)
        return None if (x, y) == (self.x, self.y) else (x, FIELD_M - y)
