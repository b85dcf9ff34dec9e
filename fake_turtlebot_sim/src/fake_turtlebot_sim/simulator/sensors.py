"""What the Kobuki's bumpers, cliff sensors and wheel switches feel (pure)."""

from __future__ import annotations

from math import inf, isclose, isfinite, pi
from typing import NamedTuple, Sequence, Tuple

from fake_turtlebot_sim.simulator.contact import Obstacle, Piece, drive_among
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.world import World

Two = Tuple[bool, bool]  # left, right
Three = Tuple[bool, bool, bool]  # left, center, right

# Half of the center bumper, and where those at its sides end (kobuki_gazebo_plugins).
CENTER_RAD, SIDE_RAD = pi / 6, pi / 2
# Of the left, center and right cliff sensor, x and y [m] in the frame of the base
# (kobuki.urdf.xacro).
CLIFF_SENSORS = ((0.08734, 0.13601), (0.156, 0.0), (0.085, -0.13601))
SAME_S = 1e-8  # less than this apart the wheels drop together; a rounding, at 1 mm/s


class Sensed(NamedTuple):
    """bumpers: pressed; cliffs: no ground below; wheels: dropped."""

    bumpers: Three = (False, False, False)
    cliffs: Three = (False, False, False)
    wheels: Two = (False, False)


def bumpers(contact: float | None) -> Three:
    """Return which bumpers a push in a direction [rad, ahead is 0, left positive] presses."""
    if contact is None or abs(contact) > SIDE_RAD:
        return (False, False, False)  # there is none behind
    left, right = contact > CENTER_RAD, contact < -CENTER_RAD
    return (left, not (left or right), right)


def cliffs(pose: Pose, world: World) -> Three:
    """Return which cliff sensors see no ground below a robot at a pose (x [m], y [m], yaw)."""
    if not world.cliffs:
        return (False, False, False)
    places = (composed(pose, (x, y, 0.0)) for x, y in CLIFF_SENSORS)
    left, center, right = (world.is_cliff(x, y) for x, y, _ in places)
    return (left, center, right)


def first_drop(
    pose: Pose, piece: Piece, wheel_separation: float, edges: Sequence[Obstacle]
) -> tuple[float, Two] | None:
    """Return after which time [s] within a Piece which wheels drop over an edge, in closed form.

    The place where a wheel touches the ground drives an arc of its own around the same middle as
    the robot; it meets an edge as a disc without a radius meets a wall.
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
