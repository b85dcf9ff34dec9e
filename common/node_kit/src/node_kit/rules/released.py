"""What counts as released: the one limit for sticks, and why other parts need another rule.

- joy2twist and the page see sticks: released is within RELEASED_AXIS of the rest position.
- joy_node sees events: after a loss it publishes nothing until the user touches the gamepad. The
  kernel can make up positions when a device is opened, so no position counts, only a movement.
- cmd_vel_mux sees velocities: released is exactly zero, as joy2twist and teleoperation by keys
  publish it. A small velocity moves the robot.
"""

from __future__ import annotations

from typing import Iterable

# Wider than what drivers take as a dead zone (joy's default is 0.05), for sticks that are worn.
RELEASED_AXIS = 0.1


def are_released(deflections: Iterable[float]) -> bool:
    """Return whether sticks are released. deflections: from the rest positions; NaN is none."""
    return all(abs(deflection) <= RELEASED_AXIS for deflection in deflections)
