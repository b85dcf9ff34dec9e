"""What a bumped robot does, as the Kobuki's own safety controller has it (pure)."""

from __future__ import annotations

from math import inf
from typing import Tuple

Velocity = Tuple[float, float]  # [m/s], [rad/s]

# kobuki_safety_controller: backwards, and turning away from the side that was hit.
BACK_M_S, TURN_RAD_S = -0.1, 0.4
LEFT, CENTER, RIGHT = 0, 1, 2  # kobuki_msgs
BUMPS = ("bumper", "cliff")  # kinds of sensors that are treated alike; the other: wheel_drop


class Reaction:
    """Remembers which sensors are active; times are numbers [s] that never decrease."""

    def __init__(self, extend_s: float) -> None:
        """Take how long a bumper or cliff sensor counts on after its release [s]."""
        self._extend_s = extend_s
        self.reset()

    def reset(self) -> None:
        """Forget all sensors."""
        self._until: dict[tuple[str, int], float] = {}  # when each counts no more

    def event(self, kind: str, sensor: int, is_active: bool, now: float) -> None:
        """Take that a sensor became active, or is so no more."""
        key = (kind, sensor)
        if is_active:
            self._until[key] = inf
        elif key in self._until:
            self._until[key] = now + (self._extend_s if kind in BUMPS else 0.0)

    def velocity(self, now: float) -> Velocity | None:
        """Return how the robot is to move (v [m/s], w [rad/s]); None: as it likes."""
        self._until = {key: until for key, until in self._until.items() if until > now}
        if any(kind not in BUMPS for kind, _ in self._until):
            return 0.0, 0.0
        sides = {sensor for _, sensor in self._until}
        if not sides:
            return None
        if sides == {LEFT}:
            return BACK_M_S, -TURN_RAD_S
        if sides == {RIGHT}:
            return BACK_M_S, TURN_RAD_S
        return BACK_M_S, 0.0
