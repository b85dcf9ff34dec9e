"""When a round robot on its arc touches something, in closed form (pure).

The robot is a disc. An obstacle is a segment with a radius: a wall has the radius 0, a post or
another robot the length 0. The robot drives its arc until it touches; while it pushes it turns on
the spot, as its wheels can, until its heading leads along the obstacle or away. It never slides.
All is in one frame, in metres, radians and seconds.
"""

from __future__ import annotations

from cmath import rect
from math import atan, atan2, copysign, cos, hypot, inf, pi, sin, sqrt, tau
from typing import Iterable, Iterator, NamedTuple, Sequence, Tuple

from fake_turtlebot_sim.simulator.differential_drive import Pose, Velocity, arc, between, drive

TOUCH_M = 1e-11  # a gap that counts as none: some hundred times the rounding of a place in metres
TANGENT = 1e-9  # the sine of an angle below which a motion leads along an obstacle, not into it
STRAIGHT = 1e-12  # the turn [rad] of a path that bends to nothing
LEAST_BEND = 1e-30  # [1/m] of a straight path, which so needs no formulas of its own

Obstacle = Tuple[float, float, float, float, float]  # x1, y1, x2, y2, radius [m]


class Piece(NamedTuple):
    """A part of a drive: velocity (v [m/s], w [rad/s]) goes linearly to end_velocity in dt [s]."""

    velocity: Velocity
    end_velocity: Velocity
    dt: float
    is_blocked: bool = False  # something is in the way: the robot only turns

    def until(self, dt: float) -> Piece:
        """Return its part before a time [s]."""
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
    """Return the distance [m] between a robot and an obstacle; negative inside of it."""
    px, py = nearest(x, y, obstacle)
    return hypot(px - x, py - y) - radius - obstacle[4]


def direction_to(pose: Pose, obstacle: Obstacle) -> float:
    """Return the direction [rad] in which an obstacle lies from a pose, in the frame of both."""
    px, py = nearest(pose[0], pose[1], obstacle)
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
    """A circle, seen from the robot: it leaves 0 towards 1 and bends towards 1j.

    After the way s the turn is a = bend s, and the place (sin(a) + 1j (1 - cos(a))) / bend. A
    distance, or its square, then is given where A sin(a) + B (1 - cos(a)) = C: a quadratic in
    tan(a / 2), which keeps its digits as bend goes to zero.
    """

    def __init__(self, pose: Pose, velocity: Velocity) -> None:
        self.x, self.y, yaw = pose
        v, w = velocity
        self.speed = abs(v)
        self._bend = max(LEAST_BEND, abs(w) / self.speed)  # [1/m]
        self._turn = rect(1.0 if v > 0 else -1.0, -yaw)
        self._is_mirrored = w < 0

    def _seen(self, x: float, y: float) -> complex:
        seen = complex(x - self.x, y - self.y) * self._turn
        return seen.conjugate() if self._is_mirrored else seen

    def way_to(self, obstacle: Obstacle, radius: float, longest: float) -> float | None:
        """Return the way [m] to the first touch within longest [m], or None."""
        reach = radius + obstacle[4]
        px, py = nearest(self.x, self.y, obstacle)
        distance = hypot(px - self.x, py - self.y)
        if distance - reach > longest:
            return None
        least = 0.0
        if distance - reach <= TOUCH_M:
            if not distance:
                return None  # both have one middle: every way leads out
            near = self._seen(px, py)
            towards = near.real / distance
            bends_to_it = self._bend * longest >= STRAIGHT and near.imag > 0.0
            if towards > TANGENT or (towards > -TANGENT and bends_to_it):
                return 0.0
            if towards > -TANGENT:  # along it and away: not met again before half a circle
                least = pi / self._bend
        one, other = self._seen(*obstacle[:2]), self._seen(*obstacle[2:4])
        ways = self._to_disc(one, reach)
        if one != other:
            ways += [*self._to_disc(other, reach), *self._to_wall(one, other - one, reach)]
        return min((way for way in ways if least <= way <= longest), default=None)

    def _to_wall(self, start: complex, wall: complex, reach: float) -> Iterator[float]:
        """Yield the ways [m] to touches of the inside of a wall, from either side."""
        length = abs(wall)
        along = wall / length
        for out in (1j * along, -1j * along):
            away = -(start * out.conjugate()).real
            for way in self._ways(out.real, out.imag, -self._bend * _rounded(away - reach)):
                half = 0.5 * self._bend * way
                place = rect(way * (sin(half) / half if half else 1.0), half)
                if 0.0 <= ((place - start) * along.conjugate()).real <= length:
                    yield way

    def _to_disc(self, middle: complex, reach: float) -> list[float]:
        """Return the ways [m] on which the robot comes within reach [m] of a point."""
        bend, distance = self._bend, abs(middle)
        outside = _rounded(distance - reach) * (distance + reach)
        wanted = -0.5 * bend * bend * outside
        return self._ways(-bend * middle.real, 1.0 - bend * middle.imag, wanted)

    def _ways(self, along: float, aside: float, wanted: float) -> list[float]:
        """Return where along sin(a) + aside (1 - cos(a)) falls to wanted, as ways [m] from 0 on."""
        room = along * along + wanted * (2 * aside - wanted)
        if room <= 0.0:
            return []
        sum_ = along + sqrt(room) if along >= 0 else along - sqrt(room)
        tangents = ((wanted, sum_), (-sum_, 2 * aside - wanted))  # of half the turn
        turns = [2 * (atan(up / low) if low else pi / 2) % tau for up, low in tangents]
        falls = (turn for turn in turns if along * cos(turn) + aside * sin(turn) < 0.0)
        return [turn / self._bend for turn in falls]


def _rounded(gap_m: float) -> float:
    """Return 0 for a gap below none: a robot that leaves may be inside by a rounding."""
    return 0.0 if -TOUCH_M <= gap_m < 0.0 else gap_m


def drive_among(
    pose: Pose, whole: Piece, radius: float, obstacles: Sequence[Obstacle]
) -> tuple[list[Piece], float | None]:
    """Split a drive into Pieces without a touch and turns on the spot.

    Returns them with the direction [rad] of what the robot pushes at the end, or None. Once it
    pushes while its velocity changes, it only turns for the rest.
    """
    velocity, end_velocity, left, _ = whole
    is_ramp = velocity != end_velocity
    pieces, now = [], velocity
    for _ in range(2 * len(obstacles) + 2):  # each may be met, and turned away from, once or twice
        if is_ramp:
            met = _contact_on_ramp(pose, whole, radius, obstacles)
            now = between(velocity, end_velocity, met[0] / left) if met else end_velocity
        else:
            met = first_contact(pose, velocity, left, radius, obstacles)
        free = met[0] if met else left
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
    """Return for how long [s] the robot must turn until it no longer drives into a direction."""
    v, w = velocity
    if not w:
        return inf
    ahead = yaw if v > 0 else yaw + pi
    side = (copysign(1.0, w) * (direction - ahead) + pi) % tau - pi  # positive: yet to be passed
    return max(0.0, side + pi / 2) / abs(w)


def _contact_on_ramp(
    pose: Pose, whole: Piece, radius: float, obstacles: Sequence[Obstacle]
) -> tuple[float, Obstacle] | None:
    """Do as first_contact() where the velocity changes, and the path has no closed form.

    Going on by the gap to the nearest obstacle, again and again, never leads into one.
    """
    velocity, end_velocity, dt, _ = whole
    fastest = max(abs(velocity[0]), abs(end_velocity[0]))
    after, place, now = 0.0, pose, velocity
    while after < dt and fastest and obstacles:
        free, near = min((gap(*place[:2], radius, one), one) for one in obstacles)
        if free <= TOUCH_M and first_contact(place, now, dt, radius, [near]):
            return after, near
        after = min(dt, after + max(free, TOUCH_M) / fastest)
        now = between(velocity, end_velocity, after / dt)
        place = drive(pose, velocity, now, after)
    return None
