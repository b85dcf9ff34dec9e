"""What a bumped robot does, as the Kobuki's own safety controller has it (pure)."""

from __future__ import annotations

from math import inf
from typing import Tuple

Velocity = Tuple[float, float]  # [m/s], [rad/s]

# kobuki_safety_controller: backwards, and turning away from the side that was hit.
BACK_M_S, TURN_RAD_S = -0.1, 0.4
LEFT, CENTER, RIGHT = 0, 1, 2  # kobuki_msgs
BUMPS = ("bumper", "cliff")  # kinds of sensors that are treated alike; the other: wheel_drop
TURNS = {CENTER: 0.0, LEFT: -TURN_RAD_S, RIGHT: TURN_RAD_S}  # [rad/s] The first active one decides.


class Reaction:
    """Remembers which sensors are active; times are numbers [s] that never decrease."""

    def __init__(self, extend_s: float) -> None:
        """Take how long it backs off at least, from the last press of a bumper or cliff sensor."""
        self._extend_s = extend_s
        self._pressed_at = -inf  # the last bumper or cliff sensor
        self._velocity: Velocity | None = None  # the last one for an active sensor
        self.reset()

    def reset(self) -> None:
        """Forget all sensors; what a press extends goes on."""
        self._active: set[tuple[str, int]] = set()

    def event(self, kind: str, sensor: int, is_active: bool, now: float) -> None:
        """Take that a sensor became active, or is so no more."""
        if not is_active:
            self._active.discard((kind, sensor))
            return
        self._active.add((kind, sensor))
        if kind in BUMPS:
            self._pressed_at = now

    def velocity(self, now: float) -> Velocity | None:
        """Return how the robot is to move (v [m/s], w [rad/s]); None: as it likes."""
        if any(kind not in BUMPS for kind, _ in self._active):
            self._velocity = 0.0, 0.0
        elif self._active:
            sides = {sensor for _, sensor in self._active}
            turn = next((turn for side, turn in TURNS.items() if side in sides), 0.0)
            self._velocity = BACK_M_S, turn
        elif now - self._pressed_at >= self._extend_s:
            return None
        return self._velocity
