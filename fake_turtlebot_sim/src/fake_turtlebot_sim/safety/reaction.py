"""The reaction to bumpers, cliffs and wheel drops, that of the Kobuki's own safety controller."""

from __future__ import annotations

from math import inf
from typing import Tuple

Velocity = Tuple[float, float]  # [m/s], [rad/s]

# kobuki_safety_controller: drives backwards, and turns away from the side that was hit.
BACK_M_S, TURN_RAD_S = -0.1, 0.4
LEFT, CENTER, RIGHT = 0, 1, 2  # kobuki_msgs
BUMPS = ("bumper", "cliff")  # the sensors from which the robot backs away
TURNS = {CENTER: 0.0, LEFT: -TURN_RAD_S, RIGHT: TURN_RAD_S}  # [rad/s] The first active one decides.


class Reaction:
    """Remembers the active sensors. Times are in seconds and never decrease."""

    def __init__(self, extend_s: float) -> None:
        """Back away for at least extend_s from the last press of a bumper or cliff sensor."""
        self._extend_s = extend_s
        self._pressed_at = -inf  # a bumper or cliff sensor, last
        self._velocity: Velocity | None = None  # the last reaction to an active sensor
        self.reset()

    def reset(self) -> None:
        """Forget all sensors; an extended reaction continues."""
        self._active: set[tuple[str, int]] = set()

    def event(self, kind: str, sensor: int, is_active: bool, now: float) -> None:
        """Record that a sensor has become active or inactive."""
        if not is_active:
            self._active.discard((kind, sensor))
            return
        self._active.add((kind, sensor))
        if kind in BUMPS:
            self._pressed_at = now

    def velocity(self, now: float) -> Velocity | None:
        """Return the velocity to drive (v [m/s], w [rad/s]), or None for no reaction."""
        if any(kind not in BUMPS for kind, _ in self._active):
            self._velocity = 0.0, 0.0
        elif self._active:
            sides = {sensor for _, sensor in self._active}
            turn = next((turn for side, turn in TURNS.items() if side in sides), 0.0)
            self._velocity = BACK_M_S, turn
        elif now - self._pressed_at >= self._extend_s:
            return None
        return self._velocity
