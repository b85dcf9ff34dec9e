"""The field with its turtles and their lines: upstream's services as rules (pure)."""

from __future__ import annotations

import itertools
import math
import re
from io import BytesIO
from typing import Callable, Mapping

from PIL import Image, ImageDraw

from simulated_turtles.turtle import FIELD_M, Color, Point, Turtle

SIZE, PIXELS_PER_M = 500, 45
FARTHEST = 20_000.0  # [pixels] from the field; a line ends there
LARGEST = 10.0**38  # messages hold float32
START = (5.5444446, 5.5444446, 0.0)  # the middle, FIELD_M / 2, as a float32 has it
NAME = re.compile(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII)
# A turtle as a polygon: (ahead, left) [pixels]; turtles have the colors in turn.
LEFT = ((22, 0), (15, 5), (13, 14), (7, 11), (-9, 11), (-16, 14), (-20, 0))
SHAPE = (*LEFT, *((ahead, -left) for ahead, left in LEFT[:0:-1]))
COLORS = ("#4a7c3a", "#8a6a3a", "#3a6a8a", "#7a4a7a")


def pixel(x: float, y: float) -> tuple[float, float]:
    """Return (column, row), not rounded, of a place [m]."""
    return x * PIXELS_PER_M, (FIELD_M - y) * PIXELS_PER_M


class Field:
    """The turtles by name, on paper of SIZE x SIZE pixels. version: of the picture."""

    def __init__(
        self, background: Callable[[], Color], inform: Callable[[str], None],
        warn: Callable[[str], None], now_s: float,
    ) -> None:  # fmt: skip
        """Begin with turtle1. background: is asked for the color of a blank paper."""
        self._background, self._inform, self._warn = background, inform, warn
        self.version, self._now_s = 0, now_s
        self._begin()

    def call(self, name: str, values: Mapping[str, float | str], now_s: float) -> str:
        """Do what a service, or TURTLE/command, is called for; return its answer.

        Raises ValueError, one line.
        """
        for value in values.values():
            if isinstance(value, float) and not abs(value) <= LARGEST:
                raise ValueError(f"{value} is no length, angle or velocity of a turtle")
        self.step(now_s)
        self.version += 1
        turtle_name, _, service = name.rpartition("/")
        if not turtle_name:
            return getattr(self, service)(**values) or ""
        turtle = self.turtles.get(turtle_name)
        if not turtle:  # killed meanwhile
            raise ValueError(f"there is no turtle [{turtle_name}]")
        start = turtle.place
        getattr(turtle, service)(**values)
        self._draw(turtle, start)
        return ""

    def clear(self) -> None:
        """Have a blank paper."""
        self._inform("Clearing turtlesim.")
        self._fill()

    def reset(self) -> None:
        """Have a blank paper, and turtle1 alone."""
        self._inform("Resetting turtlesim.")
        self._begin()

    def _fill(self) -> None:
        self._paper = Image.new("RGB", (SIZE, SIZE), self._background())

    def _begin(self) -> None:
        self._fill()
        self.turtles: dict[str, Turtle] = {}
        self._names = map("turtle{}".format, itertools.count(1))
        self.spawn(*START, "")

    def spawn(self, x: float, y: float, theta: float, name: str) -> str:
        """Add a turtle; return its name, which is chosen if it is empty."""
        if name in self.turtles:
            raise ValueError(f"A turtled named [{name}] already exists")  # upstream's words
        if name and not NAME.fullmatch(name):
            raise ValueError(f"[{name}] cannot name a turtle: take letters, digits and _")
        name = name or next(one for one in self._names if one not in self.turtles)
        self.turtles[name] = Turtle(x, y, theta, self._now_s)
        self._inform(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return name

    def kill(self, name: str) -> None:
        """Remove a turtle; its lines stay."""
        if not self.turtles.pop(name, None):
            raise ValueError(f"Tried to kill turtle [{name}], which does not exist")

    def step(self, now_s: float) -> None:
        """Drive all turtles until now."""
        self._now_s = now_s
        for turtle in self.turtles.values():
            start = turtle.place
            self.version += any(turtle.velocity)
            turtle.advance(now_s)
            outside = turtle.clamp()
            if outside:
                words = "[x={:f}, y={:f}]".format(*outside)
                self._warn(f"Oh no! I hit the wall! (Clamping from {words})")
            turtle.seen = self.color_at(*turtle.place)
            self._draw(turtle, start)

    def color_at(self, x: float, y: float) -> Color:
        """Return the color of a place [m] in the field."""
        column, row = map(round, pixel(x, y))
        red, green, blue = self._paper.getpixel((column, row))
        return red, green, blue

    def picture(self, kind: str) -> bytes:
        """Return the field with its turtles and their names as an image of a kind: PNG, PPM."""
        shown, data = self._paper.copy(), BytesIO()
        pen = ImageDraw.Draw(shown)
        for (name, turtle), color in zip(self.turtles.items(), itertools.cycle(COLORS)):
            (x, y), cos, sin = pixel(*turtle.place), math.cos(turtle.theta), math.sin(turtle.theta)
            polygon = [(x + a * cos - b * sin, y - a * sin - b * cos) for a, b in SHAPE]
            pen.polygon(polygon, color, "#222")
            pen.text((x + 17, y + 17), name, "#222")  # a shadow
            pen.text((x + 16, y + 16), name, "white")
        shown.save(data, kind, compress_level=1)
        return data.getvalue()

    def _draw(self, turtle: Turtle, start: Point) -> None:
        """Draw the way of a turtle from where it was, if its pen is down."""
        if not turtle.is_down or start == turtle.place:
            return
        pen, reach = ImageDraw.Draw(self._paper), (turtle.width - 1) / 2
        both = (*pixel(*start), *pixel(*turtle.place))
        ends = [round(min(max(one, -FARTHEST), FARTHEST)) for one in both]
        pen.line(ends, turtle.color, turtle.width)
        for x, y in (ends[:2], ends[2:]):  # The ends are round.
            pen.ellipse((x - reach, y - reach, x + reach, y + reach), turtle.color)
