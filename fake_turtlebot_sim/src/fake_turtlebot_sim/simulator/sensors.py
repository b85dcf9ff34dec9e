"""What the Kobuki's bumpers, cliff sensors and wheel switches feel (pure)."""

from __future__ import annotations

from math import pi
from typing import NamedTuple, Tuple

from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.world import World

Three = Tuple[bool, bool, bool]  # left, center, right

# Half of the center bumper, and where those at its sides end (kobuki_gazebo_plugins).
CENTER_RAD, SIDE_RAD = pi / 6, pi / 2
# Of the left, center and right cliff sensor, x and y [m] in the frame of the base
# (kobuki.urdf.xacro).
CLIFF_SENSORS = ((0.08734, 0.13601), (0.156, 0.0), (0.085, -0.13601))


class Sensed(NamedTuple):
    """bumpers: pressed; cliffs: no ground below; wheels: dropped, (left, right)."""

    bumpers: Three = (False, False, False)
    cliffs: Three = (False, False, False)
    wheels: tuple[bool, bool] = (False, False)


def bumpers(contact: float | None) -> Three:
    """Return which bumpers a push in a direction [rad, ahead is 0, left positive] presses."""
    if contact is None or abs(contact) > SIDE_RAD:
        return (False, False, False)  # there is none behind
    is_ahead = abs(contact) <= CENTER_RAD
    return (contact > CENTER_RAD, is_ahead, contact < -CENTER_RAD)


def cliffs(pose: Pose, world: World) -> Three:
    """Return which cliff sensors see no ground below a robot at a pose (x [m], y [m], yaw)."""
    if not world.cliffs:
        return (False, False, False)
    places = (composed(pose, (x, y, 0.0)) for x, y in CLIFF_SENSORS)
    left, center, right = (world.is_cliff(x, y) for x, y, _ in places)
    return (left, center, right)
