"""The contact of a round robot with obstacles on its path, exact up to rounding.

The robot is a disc. An obstacle is a segment with a radius: a wall has the radius 0, a post or
another robot the length 0. The robot drives its path until it touches an obstacle. While it pushes,
it can only turn on the spot, until its heading leads along the obstacle or away from it. It never
slides. Everything is in one frame, in metres, radians and seconds.
"""

from __future__ import annotations

from math import atan2, ceil, copysign, cos, hypot, inf, pi, tau
from typing import Callable, NamedTuple, Sequence, Tuple

from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity, arc, between, drive

TOUCH_M = 1e-11  # a smaller gap is a touch: about a hundred times the rounding of a position
TANGENT = 1e-9  # the sine of an angle below which a motion leads along an obstacle, not into it
MOST_LINES = 50  # each line leaves at most a quarter of the gap
HALVINGS = 52  # so many halvings of a time reach its rounding

Obstacle = Tuple[float, float, float, float, float]  # x1, y1, x2, y2, radius [m]


class Piece(NamedTuple):
    """A part of a drive: velocity (v [m/s], w [rad/s]) goes linearly to end_velocity in dt [s]."""

    velocity: Velocity
    end_velocity: Velocity
    dt: float
    is_blocked: bool = False  # by an obstacle: the robot only turns

    def until(self, dt: float) -> Piece:
        """Return the part of this piece before a time [s]."""
        end = between(self.velocity, self.end_velocity, dt / self.dt if self.dt else 0.0)
        return Piece(self.velocity, end, dt)


def nearest(x: float, y: float, obstacle: Obstacle) -> tuple[float, float]:
    """Return the point of an obstacle's segment that is nearest to (x, y) [m]."""
    x1, y1, x2, y2, _ = obstacle
    dx, dy = x2 - x1, y2 - y1
    length2 = dx * dx + dy * dy
    share = ((x - x1) * dx + (y - y1) * dy) / length2 if length2 else 0.0
    share = min(1.0, max(0.0, share))
    return x1 + share * dx, y1 + share * dy


def gap(x: float, y: float, radius: float, obstacle: Obstacle) -> float:
    """Return the distance [m] between a robot and an obstacle, negative inside it."""
    px, py = nearest(x, y, obstacle)
    return hypot(px - x, py - y) - radius - obstacle[4]


def direction_to(pose: Pose, obstacle: Obstacle) -> float:
    """Return the direction [rad] of an obstacle from a pose, in the frame of both."""
    px, py = nearest(pose[0], pose[1], obstacle)
    return atan2(py - pose[1], px - pose[0])


def first_contact(
    pose: Pose, whole: Piece, radius: float, obstacles: Sequence[Obstacle]
) -> tuple[float, Obstacle] | None:
    """Return the time [s] until a driving disc touches an obstacle, and the obstacle, or None.

    An obstacle that it touches already counts only if the disc drives into it. The path is cut
    where it reverses or turns back, and into quarters of a turn.
    """
    velocity, end_velocity, dt, _ = whole
    longest = dt * max(abs(velocity[0]), abs(end_velocity[0]))
    x, y, _ = pose
    near = [wall for wall in obstacles if gap(x, y, radius, wall) <= longest] if longest else []
    if not near:
        return None
    quarters = ceil(max(abs(velocity[1]), abs(end_velocity[1])) * dt / (pi / 2))
    shares = {1.0, *((k + 1) / quarters for k in range(quarters))}
    shares |= {a / (a - b) for a, b in zip(velocity, end_velocity) if a * b < 0.0}
    after, now = 0.0, velocity
    for share in sorted(shares):
        end = between(velocity, end_velocity, share)
        part, first = Piece(now, end, share * dt - after), None
        for obstacle in near:
            time = _contact_on_part(pose, part, radius, obstacle)
            if time is not None:
                part, first = part.until(time), obstacle
        if first:
            return after + part.dt, first
        pose, now, after = drive(pose, *part[:2], part.dt), end, share * dt
    return None


def _contact_on_part(pose: Pose, part: Piece, radius: float, obstacle: Obstacle) -> float | None:
    """Return the time [s] until the robot touches an obstacle in a part of a drive, or None.

    All of an obstacle is beyond the line through its nearest point, perpendicular to the direction
    of that point. The robot drives to this line, then to the next one, until it touches.
    """
    rest = part
    for _ in range(MOST_LINES):
        free = gap(*pose[:2], radius, obstacle)
        if rest is not part and free <= TOUCH_M:
            break
        fastest = max(abs(rest.velocity[0]), abs(rest.end_velocity[0]))
        if not fastest or free > rest.dt * fastest or free <= -radius - obstacle[4]:
            return None  # too far, or both have the same centre, from which every way leads out
        time = _time_to_line((-free, 0.0, pose[2] - direction_to(pose, obstacle)), rest)
        if not time:
            return None if time is None else part.dt - rest.dt
        done = rest.until(time)
        pose, rest = drive(pose, *done[:3]), Piece(done[1], rest[1], rest.dt - time)
    return part.dt - rest.dt


def _time_to_line(pose: Pose, part: Piece) -> float | None:
    """Return the time [s] until the robot crosses the line x = 0 in a part of a drive, or None.

    Yaw changes by at most a quarter of a turn, so x grows in a single interval of time, or never.
    """
    sign = copysign(1.0, part.velocity[0] + part.end_velocity[0])

    def at(time: float) -> tuple[float, float]:  # x [m], and the sine of the angle to the line
        x, _, yaw = drive(pose, *part.until(time)[:2], time)
        return x, sign * cos(yaw)

    begin, end = 0.0, part.dt
    if at(0.0)[1] <= 0.0:
        begin = _halved(lambda time: at(time)[1] > 0.0, begin, end)
    else:
        end = _halved(lambda time: at(time)[1] <= 0.0, begin, end)
    if at(begin)[0] >= -TOUCH_M:
        return begin if at(0.5 * (begin + end))[1] > TANGENT else None
    return _halved(lambda time: at(time)[0] >= 0.0, begin, end) if at(end)[0] >= 0.0 else None


def _halved(is_later: Callable[[float], bool], low: float, high: float) -> float:
    """Return the last time [s] between low and high before is_later becomes true, by bisection."""
    if not is_later(high):
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if is_later(middle) else (middle, high)
    return low


def drive_among(
    pose: Pose, whole: Piece, radius: float, obstacles: Sequence[Obstacle]
) -> tuple[list[Piece], float | None]:
    """Split a drive into Pieces free of contact and turns on the spot.

    Returns them with the direction [rad] of the obstacle that the robot pushes at the end, or None.
    If it touches one while its velocity changes, it only turns for the rest of the drive.
    """
    velocity, end_velocity, left, _ = whole
    is_ramp = velocity != end_velocity
    pieces = []
    for _ in range(2 * len(obstacles) + 2):  # each obstacle may be touched once or twice
        rest = Piece(velocity, end_velocity, left)
        met = first_contact(pose, rest, radius, obstacles)
        free = met[0] if met else left
        now = rest.until(free).end_velocity if met else end_velocity
        pieces.append(Piece(velocity, now, free))
        if met is None:
            return pieces, None
        pose = drive(pose, velocity, now, free)
        contact = direction_to(pose, met[1])
        left -= free
        turning = left if is_ramp else min(left, _time_to_turn_away(pose[2], velocity, contact))
        pieces.append(Piece((0.0, now[1]), (0.0, end_velocity[1]), turning, True))
        left -= turning
        if left <= 0.0:
            break
        pose = arc(pose, (0.0, velocity[1]), turning)
    return pieces, contact


def _time_to_turn_away(yaw: float, velocity: Velocity, direction: float) -> float:
    """Return the time [s] that the robot must turn until it no longer drives in a direction."""
    v, w = velocity
    if not w:
        return inf
    ahead = yaw if v > 0 else yaw + pi
    side = (copysign(1.0, w) * (direction - ahead) + pi) % tau - pi  # positive: still ahead
    return max(0.0, side + pi / 2) / abs(w)
