"""One turtle: where it is, and how commands and teleports move it (pure)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

FIELD_M = 499 / 45  # upstream's window of 500 pixels, at 45 pixels a metre
COMMAND_S = 1.0  # a velocity lasts so long
LARGEST = 1e38  # messages hold float32
PEN_COLOR, PEN_WIDTH = (179, 184, 255), 3  # upstream's

Point = tuple  # (x, y) [m], from the lower left corner
Color = tuple  # (r, g, b), each 0 to 255


def check_numbers(*values: float) -> None:
    """Raise ValueError unless all values are finite and fit a message."""
    for value in values:
        if not abs(value) <= LARGEST:
            raise ValueError(f"{value} is no length, angle or velocity of a turtle")


def normalized(theta: float) -> float:
    """Return an angle [rad] as the same one in [-pi, pi)."""
    return theta - 2 * math.pi * math.floor((theta + math.pi) / (2 * math.pi))


@dataclass
class Pen:
    """What a turtle draws with: width [pixels]."""

    color: Color = PEN_COLOR
    width: int = PEN_WIDTH
    is_on: bool = True


@dataclass
class Turtle:
    """A turtle at (x, y) [m] and theta [rad]; its velocities are its own: ahead, to the left, turn."""

    x: float
    y: float
    theta: float
    time_s: float  # of this pose
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [m/s, m/s, rad/s]
    until_s: float = 0.0  # the end of the last command
    pen: Pen = field(default_factory=Pen)

    def command(self, ahead: float, left: float, turn: float, now_s: float) -> None:
        """Obey velocities [m/s, m/s, rad/s] from now on, for COMMAND_S."""
        check_numbers(ahead, left, turn)
        self.advance(now_s)
        self.velocity, self.until_s = (ahead, left, turn), now_s + COMMAND_S

    def advance(self, now_s: float) -> None:
        """Drive until now, on an exact arc; walls are not looked at."""
        ahead, left, turn = self.velocity
        dt_s = max(0.0, min(now_s, self.until_s) - self.time_s)
        half = turn * dt_s / 2
        chord = dt_s * (math.sin(half) / half if half else 1.0)  # of a velocity of 1 m/s
        cos, sin = math.cos(self.theta + half), math.sin(self.theta + half)
        self.x += chord * (ahead * cos - left * sin)
        self.y += chord * (ahead * sin + left * cos)
        self.theta = normalized(self.theta + turn * dt_s)
        self.time_s = now_s
        if now_s >= self.until_s:
            self.velocity = (0.0, 0.0, 0.0)

    def jump_to(self, x: float, y: float, theta: float) -> None:
        """Be elsewhere at once. As upstream's, only y is bounded here, and only above."""
        check_numbers(x, y, theta)
        self.x, self.y, self.theta = x, min(y, FIELD_M), theta

    def jump_by(self, linear: float, angular: float) -> None:
        """Turn, then go straight on, both at once."""
        check_numbers(linear, angular)
        self.theta += angular
        self.x += linear * math.cos(self.theta)
        self.y += linear * math.sin(self.theta)

    def clamp(self) -> Point | None:
        """Return to the field; return where the turtle was outside, with y from the top as upstream."""
        was = (self.x, self.y)
        self.x, self.y = (min(max(value, 0.0), FIELD_M) for value in was)
        return None if was == (self.x, self.y) else (was[0], FIELD_M - was[1])
