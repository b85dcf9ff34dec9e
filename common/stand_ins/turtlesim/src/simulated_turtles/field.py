"""The field with its turtles and their lines, and upstream's services as methods.

Places are complex numbers, x + y j [m], from the lower left corner of the field.
"""

from __future__ import annotations

import cmath
import itertools
import logging
import math
import re
from io import BytesIO
from typing import Callable, Mapping, Sequence

from PIL import Image, ImageDraw

from simulated_turtles.pen import covered

SIZE, PIXELS_PER_M = 500, 45
FIELD_M = (SIZE - 1) / PIXELS_PER_M  # as upstream's window
COMMAND_S = 1.0  # how long a velocity lasts
FARTHEST = 20_000.0  # [pixels] from the field; a line ends there
LARGEST = 10.0**38  # messages have float32
START = (5.5444446, 5.5444446, 0.0)  # the centre, FIELD_M / 2, as a float32
NAME = re.compile(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII)
# A turtle as a polygon: ahead + right j [pixels]; turtles take the colors in turn.
RIGHT = (22, 15 - 5j, 13 - 14j, 7 - 11j, -9 - 11j, -16 - 14j, -20)
SHAPE = (*RIGHT, *(corner.conjugate() for corner in RIGHT[:0:-1]))
COLORS = ("#4a7c3a", "#8a6a3a", "#3a6a8a", "#7a4a7a")
SAID = {"clear": "Clearing turtlesim.", "reset": "Resetting turtlesim."}
LOG = logging.getLogger("rosout")  # rospy's own


def pixel(place: complex) -> tuple[float, float]:
    """Return the (column, row) of a place [m], not rounded."""
    return place.real * PIXELS_PER_M, (FIELD_M - place.imag) * PIXELS_PER_M


def near(place: complex) -> complex:
    """Return the pixel of a place as column + row j, at most FARTHEST away."""
    column, row = (min(max(value, -FARTHEST), FARTHEST) for value in pixel(place))
    return complex(column, row)


class Turtle:
    """A turtle at a place and theta [rad]. Services and their fields are named as upstream's."""

    color: Sequence[int] = (179, 184, 255)  # (r, g, b) of the pen, as upstream's
    width, is_down = 3, True  # [pixels]; whether it draws
    seen: Sequence[int]  # the color below it, before it draws there, as upstream's sensor
    velocity, turn, remaining_s = 0j, 0.0, 0.0  # ahead + left j [m/s], [rad/s], time left

    def __init__(self, x: float, y: float, theta: float) -> None:
        self.place = self.drawn = complex(x, y)  # drawn: the end of its line
        self.theta = theta

    def command(self, ahead: float, left: float, turn: float) -> None:
        """Obey velocities [m/s, m/s, rad/s] from now on, for COMMAND_S."""
        self.velocity, self.turn, self.remaining_s = complex(ahead, left), turn, COMMAND_S

    def advance(self, passed_s: float) -> None:
        """Drive for a time on an exact arc, without regard to walls."""
        dt_s = min(passed_s, self.remaining_s)
        half = self.turn * dt_s / 2
        chord_s = dt_s * (math.sin(half) / half if half else 1.0)
        self.place += self.velocity * cmath.rect(chord_s, self.theta + half)
        self.theta = math.remainder(self.theta + 2 * half, math.tau)
        self.remaining_s -= dt_s
        if not self.remaining_s:
            self.velocity, self.turn = 0j, 0.0

    def teleport_absolute(self, x: float, y: float, theta: float) -> None:
        """Move to a pose at once; as upstream, limit only y, and only from above."""
        self.place, self.theta = complex(x, min(y, FIELD_M)), theta

    def teleport_relative(self, linear: float, angular: float) -> None:
        """Turn [rad], then move ahead [m], at once."""
        self.theta += angular
        self.place += cmath.rect(linear, self.theta)

    def set_pen(self, r: int, g: int, b: int, width: int, off: int) -> None:
        """Lift the pen, or put down a pen with a color and a width [pixels]."""
        self.is_down = not off
        if not off:
            self.color, self.width = (r, g, b), width or 1

    @property
    def pose(self) -> tuple[float, float, float, float, float]:
        """The values of turtlesim/Pose; as upstream, the linear velocity has no sign."""
        return self.place.real, self.place.imag, self.theta, abs(self.velocity), self.turn


class Field:
    """The turtles by name, on a paper of SIZE x SIZE pixels. version: of the picture."""

    def __init__(self, background: Callable[[], Sequence[int]], now_s: float) -> None:
        """Start with turtle1. background: returns (r, g, b) of a blank paper."""
        self._background, self.version, self._now_s = background, 0, now_s
        self.reset()

    def call(self, name: str, values: Mapping[str, float | str], now_s: float) -> str | None:
        """Execute a service, or TURTLE/command, and return its response. Raises ValueError."""
        for value in values.values():
            if isinstance(value, float) and not abs(value) <= LARGEST:
                raise ValueError(f"{value} is not a length, angle or velocity of a turtle")
        self.step(now_s)
        self.version += 1
        of, _, service = name.rpartition("/")
        if of and of not in self.turtles:  # it was killed meanwhile
            raise ValueError(f"there is no turtle [{of}]")
        if service in SAID:
            LOG.info(SAID[service])
        answer: str | None = getattr(self.turtles.get(of, self), service)(**values)
        self._draw()
        return answer

    def clear(self) -> None:
        self._paper = Image.new("RGB", (SIZE, SIZE), self._background())

    def reset(self) -> None:
        self.clear()
        self.turtles: dict[str, Turtle] = {}
        self._names = map("turtle{}".format, itertools.count(1))
        self.spawn(*START, "")

    def spawn(self, x: float, y: float, theta: float, name: str) -> str:
        """Add a turtle and return its name; an empty name is replaced."""
        if name in self.turtles:
            raise ValueError(f"A turtled named [{name}] already exists")  # upstream's words
        if name and not NAME.fullmatch(name):
            raise ValueError(f"[{name}] cannot name a turtle: take letters, digits and _")
        name = name or next(free for free in self._names if free not in self.turtles)
        self.turtles[name] = Turtle(x, y, theta)
        LOG.info(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return name

    def kill(self, name: str) -> None:
        """Remove a turtle; its lines stay."""
        if not self.turtles.pop(name, None):
            raise ValueError(f"Tried to kill turtle [{name}], which does not exist")

    def step(self, now_s: float) -> None:
        """Drive all turtles until now."""
        passed_s, self._now_s = max(0.0, now_s - self._now_s), now_s
        for turtle in self.turtles.values():
            self.version += bool(turtle.velocity or turtle.turn)
            turtle.advance(passed_s)
            x, y, *_ = turtle.pose
            turtle.place = complex(*(min(max(value, 0.0), FIELD_M) for value in (x, y)))
            if turtle.place != complex(x, y):  # y from the top, as upstream
                LOG.warning(f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={FIELD_M - y:f}])")
            turtle.seen = self._paper.getpixel(tuple(map(round, pixel(turtle.place))))
        self._draw()

    def picture(self, kind: str) -> bytes:
        """Return an image, PNG or PPM, of the field with its turtles and their names."""
        image, data = self._paper.copy(), BytesIO()
        pen = ImageDraw.Draw(image)
        for (name, turtle), color in zip(self.turtles.items(), itertools.cycle(COLORS)):
            (x, y), heading = pixel(turtle.place), cmath.rect(1.0, -turtle.theta)
            outline = [complex(x, y) + heading * corner for corner in SHAPE]
            pen.polygon([(p.real, p.imag) for p in outline], color, "#222")
            for shift, shade in ((17, "#222"), (16, "white")):
                pen.text((x + shift, y + shift), name, shade)
        image.save(data, kind, compress_level=1)
        return data.getvalue()

    def _draw(self) -> None:
        """Draw the path of each turtle whose pen is down, since the last call."""
        pen = ImageDraw.Draw(self._paper)
        for turtle in self.turtles.values():
            start, turtle.drawn = turtle.drawn, turtle.place
            if turtle.is_down and start != turtle.place:
                points = covered(near(start), near(turtle.place), turtle.width, SIZE)
                pen.point(points.ravel().tolist(), tuple(turtle.color))
