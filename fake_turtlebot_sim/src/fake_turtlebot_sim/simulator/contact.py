"""When a round robot on its arc touches something, in closed form (pure).

The robot is a disc; walls are segments, posts and other robots are discs. Everything is in one
frame, in metres, radians and seconds. The robot drives its arc until it touches; while it pushes it
turns on the spot, as its wheels can, until its heading leads along the obstacle or away. It never
slides.
"""

from __future__ import annotations

from math import atan2, cos, hypot, inf, pi, sin, sqrt, tau
from typing import Iterable, Iterator, NamedTuple, Sequence, Tuple, Union

from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity, arc, between, drive

TOUCH_M = 1e-11  # a gap that counts as none: some hundred times the rounding of a place in metres
TANGENT = 1e-9  # the sine of an angle below which a motion leads along an obstacle, not into it
STRAIGHT = 1e-12  # the turn [rad] of a path that bends to nothing
LEAST_BEND = 1e-30  # [1/m] of a straight path, which so needs no formulas of its own

Segment = Tuple[float, float, float, float]  # x1, y1, x2, y2 [m]
Disc = Tuple[float, float, float]  # x, y, radius [m]
Obstacle = Union[Segment, Disc]


class Piece(NamedTuple):
    """A part of a drive: velocity (v [m/s], w [rad/s]) goes linearly to end_velocity in dt [s]."""

    velocity: Velocity
    end_velocity: Velocity
    dt: float
    is_blocked: bool = False  # something is in the way: the robot only turns


def nearest(x: float, y: float, obstacle: Obstacle) -> tuple[float, float, float]:
    """Return the point of an obstacle's core that is nearest to (x, y), and its radius [m]."""
    if len(obstacle) == 3:
        return obstacle
    x1, y1, x2, y2 = obstacle
    dx, dy = x2 - x1, y2 - y1
    length2 = dx * dx + dy * dy
    share = ((x - x1) * dx + (y - y1) * dy) / length2 if length2 else 0.0
    share = min(1.0, max(0.0, share))
    return x1 + share * dx, y1 + share * dy, 0.0


def gap(x: float, y: float, radius: float, obstacle: Obstacle) -> float:
    """Return the distance [m] between a robot and an obstacle; negative inside of it."""
    px, py, core = nearest(x, y, obstacle)
    return hypot(px - x, py - y) - radius - core


def direction_to(pose: Pose, obstacle: Obstacle) -> float:
    """Return the direction [rad] in which an obstacle lies from a pose, in the frame of both."""
    px, py, _ = nearest(pose[0], pose[1], obstacle)
    return atan2(py - pose[1], px - pose[0])


def first_contact(
    pose: Pose, velocity: Velocity, dt: float, radius: float, obstacles: Iterable[Obstacle]
) -> tuple[float, Obstacle] | None:
    """Return after which time [s] within dt a disc on its arc touches which obstacle, or None.

    What it touches already counts only if it drives into it.
    """
    first = None
    if velocity[0]:
        motion = _Motion(pose, velocity)
        for obstacle in obstacles:
            way = motion.way_to(obstacle, radius, motion.speed * dt)
            if way is not None:
                dt = way / motion.speed
                first = dt, obstacle
    return first


class _Motion:
    """A circle: the place x, y, a unit vector ahead, one to the side of the turn.

    After the way s the turn is a = bend s; the place has moved sin(a) / bend ahead and
    (1 - cos(a)) / bend to the side. A distance, or its square, then is given where
    A sin(a) + B (1 - cos(a)) = C: a quadratic in tan(a / 2), which keeps its digits as bend
    goes to zero.
    """

    def __init__(self, pose: Pose, velocity: Velocity) -> None:
        self.x, self.y, yaw = pose
        v, w = velocity
        self.speed = abs(v)
        self.bend = max(LEAST_BEND, abs(w) / self.speed)  # [1/m]
        sense = 1.0 if v > 0 else -1.0
        side = 1.0 if w > 0 else -1.0
        self.ahead = ux, uy = sense * cos(yaw), sense * sin(yaw)
        self.side = -side * uy, side * ux

    def way_to(self, obstacle: Obstacle, radius: float, longest: float) -> float | None:
        """Return the way [m] to the first touch within longest [m], or None."""
        px, py, core = nearest(self.x, self.y, obstacle)
        dx, dy = px - self.x, py - self.y
        distance = hypot(dx, dy)
        free = distance - core - radius
        if free > longest:
            return None
        least = 0.0
        if free <= TOUCH_M:
            if not distance:
                return None  # both have one middle: every way leads out
            towards = (dx * self.ahead[0] + dy * self.ahead[1]) / distance
            bends = self.bend * longest >= STRAIGHT
            bends_to_it = bends and dx * self.side[0] + dy * self.side[1] > 0.0
            if towards > TANGENT or (towards > -TANGENT and bends_to_it):
                return 0.0
            if towards > -TANGENT:  # along it and away: not met again before half a circle
                least = pi / self.bend
        if len(obstacle) == 3:
            ways = self._to_disc(px, py, core + radius)
        else:
            ways = [*self._to_wall(obstacle, radius, longest)]
            ways += self._to_disc(*obstacle[:2], radius) + self._to_disc(*obstacle[2:], radius)
        return min((way for way in ways if least <= way <= longest), default=None)

    def _to_wall(self, wall: Segment, radius: float, longest: float) -> Iterator[float]:
        """Yield the ways [m] to touches of the inside of a wall, from either side."""
        x1, y1, x2, y2 = wall
        length = hypot(x2 - x1, y2 - y1)
        if not length:
            return
        tx, ty = (x2 - x1) / length, (y2 - y1) / length
        for nx, ny in ((-ty, tx), (ty, -tx)):
            away = (self.x - x1) * nx + (self.y - y1) * ny
            along = self.ahead[0] * nx + self.ahead[1] * ny
            aside = self.side[0] * nx + self.side[1] * ny
            for way in self._ways(along, aside, self.bend * _rounded(radius - away)):
                if way <= longest:
                    x, y = self._place(way)
                    if 0.0 <= (x - x1) * tx + (y - y1) * ty <= length:
                        yield way

    def _to_disc(self, px: float, py: float, reach: float) -> list[float]:
        """Return the ways [m] on which the middle comes within reach [m] of a point."""
        ex, ey = self.x - px, self.y - py
        along = ex * self.ahead[0] + ey * self.ahead[1]
        aside = ex * self.side[0] + ey * self.side[1]
        distance = hypot(ex, ey)
        outside = _rounded(distance - reach) * (distance + reach)
        bend = self.bend
        return self._ways(bend * along, bend * aside + 1.0, -0.5 * bend * bend * outside)

    def _ways(self, along: float, aside: float, wanted: float) -> list[float]:
        """Return where along sin(a) + aside (1 - cos(a)) falls to wanted, as ways [m] from 0 on."""
        room = along * along + wanted * (2 * aside - wanted)
        if room <= 0.0:
            return []
        sum_ = along + sqrt(room) if along >= 0 else along - sqrt(room)
        tangents = ((wanted, sum_), (-sum_, 2 * aside - wanted))
        halves = [atan2(up, low) if low > 0 else atan2(-up, -low) for up, low in tangents]
        turns = [2 * half if half >= 0 else 2 * half + tau for half in halves]
        falls = (turn for turn in turns if along * cos(turn) + aside * sin(turn) < 0.0)
        return [turn / self.bend for turn in falls]

    def _place(self, way: float) -> tuple[float, float]:
        half = 0.5 * self.bend * way
        chord = way * (sin(half) / half if half else 1.0)
        ahead, aside = chord * cos(half), chord * sin(half)
        return (
            self.x + ahead * self.ahead[0] + aside * self.side[0],
            self.y + ahead * self.ahead[1] + aside * self.side[1],
        )


def _rounded(gap_m: float) -> float:
    """Return 0 for a gap that counts as none: a robot that leaves may be inside by a rounding."""
    return gap_m if abs(gap_m) > TOUCH_M else 0.0


def drive_among(
    pose: Pose,
    velocity: Velocity,
    end_velocity: Velocity,
    dt: float,
    radius: float,
    obstacles: Sequence[Obstacle],
) -> tuple[list[Piece], float | None]:
    """Split a drive into Pieces without a touch and turns on the spot.

    Returns them with the direction [rad] of what the robot pushes at the end, or None. Its velocity
    goes linearly to end_velocity.
    """
    if velocity != end_velocity:
        return _ramp_among(pose, velocity, end_velocity, dt, radius, obstacles)
    w = velocity[1]
    pieces, left = [], dt
    for _ in range(2 * len(obstacles) + 2):  # each may be met, and turned away from, once or twice
        met = first_contact(pose, velocity, left, radius, obstacles)
        free = met[0] if met else left
        pose = arc(pose, velocity, free)
        left -= free
        pieces.append(Piece(velocity, velocity, free))
        if met is None:
            return pieces, None
        contact = direction_to(pose, met[1])
        turning = min(left, _time_to_turn_away(pose[2], velocity, contact))
        pose = arc(pose, (0.0, w), turning)
        left -= turning
        pieces.append(Piece((0.0, w), (0.0, w), turning, True))
        if left <= 0.0:
            break
    return pieces, contact


def _time_to_turn_away(yaw: float, velocity: Velocity, direction: float) -> float:
    """Return for how long [s] the robot must turn until it no longer drives into a direction."""
    v, w = velocity
    if not w:
        return inf
    ahead = yaw if v > 0 else yaw + pi
    sense = 1.0 if w > 0 else -1.0
    side = ((direction - ahead) * sense + pi) % tau - pi  # positive: it is yet to be passed
    return max(0.0, side + pi / 2) / abs(w)


def _ramp_among(
    pose: Pose,
    velocity: Velocity,
    end_velocity: Velocity,
    dt: float,
    radius: float,
    obstacles: Sequence[Obstacle],
) -> tuple[list[Piece], float | None]:
    """Do as drive_among() where the velocity changes, and the path has no closed form.

    The robot goes on by its gap to the nearest obstacle, again and again, which never leads into
    one. Once it pushes, it only turns for the rest of dt.
    """
    fastest = max(abs(velocity[0]), abs(end_velocity[0]))
    after, place, now = 0.0, pose, velocity
    while after < dt and fastest and obstacles:
        near = min(obstacles, key=lambda one: gap(place[0], place[1], radius, one))
        free = gap(place[0], place[1], radius, near)
        if free <= TOUCH_M and first_contact(place, now, dt, radius, [near]):
            contact = direction_to(place, near)
            turns = Piece((0.0, now[1]), (0.0, end_velocity[1]), dt - after, True)
            return [Piece(velocity, now, after), turns], contact
        after = min(dt, after + max(free, TOUCH_M) / fastest)
        now = between(velocity, end_velocity, after / dt)
        place = drive(pose, velocity, now, after)
    return [Piece(velocity, end_velocity, dt)], None
