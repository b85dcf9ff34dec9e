"""The rules of draw_square: four sides of 2 m, again and again (pure)."""

from __future__ import annotations

import math

from simulated_turtles.turtle import normalized

SIDE_M, SPEED, TURN_RATE = 2.0, 1.0, 0.4  # [m, m/s, rad/s]
NEAR_M, NEAR_RAD, STILL = 0.1, 0.01, 0.0001  # upstream's tolerances

Pose = tuple  # (x, y, theta, linear velocity, angular velocity), as turtlesim/Pose


class Square:
    """Drives a side, waits until the turtle stands, turns left, waits, and begins anew."""

    def __init__(self) -> None:
        """Begin with a side, once a pose is known."""
        self._goal: tuple[float, float, float] | None = None
        self._is_side, self._is_done = False, True
        self.news: list[str] = []  # lines for the log; the caller empties it

    def step(self, pose: Pose) -> tuple[float, float]:
        """Return the velocities (ahead [m/s], turn [rad/s]) after a pose."""
        if self._goal and not self._is_done:
            self._is_done = self._is_at(pose)
        elif not self._goal or (abs(pose[3]) < STILL and abs(pose[4]) < STILL):
            self._next(pose)
        if self._is_done:
            return 0.0, 0.0
        return (SPEED, 0.0) if self._is_side else (0.0, TURN_RATE)

    def _is_at(self, pose: Pose) -> bool:
        x, y, theta = self._goal or pose[:3]
        is_there = abs(pose[0] - x) < NEAR_M and abs(pose[1] - y) < NEAR_M
        return is_there and abs(normalized(pose[2] - theta)) < NEAR_RAD

    def _next(self, pose: Pose) -> None:
        if self._goal:
            self.news.append("Reached goal")
        self._is_side, self._is_done = not self._is_side, False
        x, y, theta = pose[:3]
        if self._is_side:
            self._goal = (x + SIDE_M * math.cos(theta), y + SIDE_M * math.sin(theta), theta)
        else:
            self._goal = (x, y, normalized(theta + math.pi / 2))
        self.news.append("New goal [{:f} {:f}, {:f}]".format(*self._goal))
