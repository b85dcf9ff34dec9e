"""The rules of draw_square: sides of 2 m and turns to the left, again and again (pure)."""

from __future__ import annotations

import math
from typing import Tuple

from simulated_turtles.turtle import normalized

SIDE_M, SPEED, TURN_RATE = 2.0, 1.0, 0.4  # [m, m/s, rad/s]
NEAR_M, NEAR_RAD, STILL = 0.1, 0.01, 0.0001  # upstream's tolerances

Pose = Tuple[float, float, float, float, float]  # as in turtlesim/Pose


class Square:
    """Drives a side, waits until the turtle stands, turns, waits, and so on."""

    goal: tuple[float, float, float] | None = None
    _is_side, _is_done = False, True

    def step(self, pose: Pose) -> tuple[float, float]:
        """Return the velocities (ahead [m/s], turn [rad/s]) after a pose."""
        x, y, theta, linear, angular = pose
        if self.goal and not self._is_done:
            is_there = abs(x - self.goal[0]) < NEAR_M and abs(y - self.goal[1]) < NEAR_M
            self._is_done = is_there and abs(normalized(theta - self.goal[2])) < NEAR_RAD
        elif max(abs(linear), abs(angular)) < STILL:
            self._is_side, self._is_done = not self._is_side, False
            ahead, turn = (SIDE_M, 0.0) if self._is_side else (0.0, math.pi / 2)
            x, y = x + ahead * math.cos(theta), y + ahead * math.sin(theta)
            self.goal = (x, y, normalized(theta + turn))
        if self._is_done:
            return 0.0, 0.0
        return (SPEED, 0.0) if self._is_side else (0.0, TURN_RATE)
