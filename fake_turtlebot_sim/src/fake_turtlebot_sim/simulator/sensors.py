"""The states of the Kobuki's bumpers, cliff sensors and wheel drop switches."""

from __future__ import annotations

from math import inf, isclose, isfinite, pi
from typing import NamedTuple, Sequence, Tuple

from fake_turtlebot_sim.simulator.contact import Obstacle, Piece, drive_among
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.world import World

Two = Tuple[bool, bool]  # left, right
Three = Tuple[bool, bool, bool]  # left, center, right

# Half the angle of the center bumper, and the outer end of the side bumpers
# (kobuki_gazebo_plugins).
CENTER_RAD, SIDE_RAD = pi / 6, pi / 2
# x and y [m] of the left, center and right cliff sensor in the base frame (kobuki.urdf.xacro).
CLIFF_SENSORS = ((0.08734, 0.13601), (0.156, 0.0), (0.085, -0.13601))
SAME_S = 1e-8  # wheels that drop less than this apart drop together: rounding, at 1 mm/s


class Sensed(NamedTuple):
    """bumpers: pressed; cliffs: no floor below; wheels: dropped."""

    bumpers: Three = (False, False, False)
    cliffs: Three = (False, False, False)
    wheels: Two = (False, False)


def bumpers(contact: float | None) -> Three:
    """Return the bumpers pressed by contact in a direction [rad, 0 is ahead, left is positive]."""
    if contact is None or abs(contact) > SIDE_RAD:
        return (False, False, False)  # there is no bumper behind
    left, right = contact > CENTER_RAD, contact < -CENTER_RAD
    return (left, not (left or right), right)


def cliffs(pose: Pose, world: World) -> Three:
    """Return the cliff sensors that see no floor, for a robot at a pose (x [m], y [m], yaw)."""
    if not world.cliffs:
        return (False, False, False)
    places = (composed(pose, (x, y, 0.0)) for x, y in CLIFF_SENSORS)
    left, center, right = (world.is_cliff(x, y) for x, y, _ in places)
    return (left, center, right)


def first_drop(
    pose: Pose, piece: Piece, wheel_separation: float, edges: Sequence[Obstacle]
) -> tuple[float, Two] | None:
    """Return the time [s] until wheels drop over an edge within a Piece, and which, or None.

    The point where a wheel touches the floor follows its own arc, around the same centre as the
    robot's; it meets an edge as a disc of radius 0 meets a wall.
    """
    if not edges:
        return None
    times = []
    for aside in (0.5 * wheel_separation, -0.5 * wheel_separation):
        wheel = composed(pose, (0.0, aside, 0.0))
        begin, end = ((v - w * aside, w) for v, w in piece[:2])
        (free, *more), _ = drive_among(wheel, Piece(begin, end, piece.dt), 0.0, edges)
        times.append(free.dt if more else inf)
    first = min(times)
    left, right = (isclose(time, first, rel_tol=0.0, abs_tol=SAME_S) for time in times)
    return (first, (left, right)) if isfinite(first) else None
