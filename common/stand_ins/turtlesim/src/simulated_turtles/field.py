"""The field with its turtles: upstream's services as rules (pure; time is an argument)."""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple

from simulated_turtles.paper import Paper
from simulated_turtles.turtle import Color, Pen, Point, Turtle, check_numbers

PERIOD_S = 0.016  # 62.5 Hz
BACKGROUND = {"background_r": 69, "background_g": 86, "background_b": 255}
START = (5.5444446, 5.5444446, 0.0)  # the middle, FIELD_M / 2, as a float32 has it
NAME = re.compile(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII)


class FieldError(ValueError):
    """A request that is refused; the text is upstream's, where it has one."""


class State(NamedTuple):
    """What a turtle publishes; `outside` is where it hit the wall, with y from the top."""

    name: str
    pose: tuple[float, float, float, float, float]  # in the order of turtlesim/Pose
    color: Color
    outside: Point | None


def background(given: dict[str, Any]) -> Color:
    """Return the color of parameters; the default for what is no integer, as upstream."""
    found = (given.get(name, default) for name, default in BACKGROUND.items())
    pairs = zip(found, BACKGROUND.values())
    return tuple(one & 255 if isinstance(one, int) else default for one, default in pairs)


def wait_s(due_s: float, now_s: float) -> tuple[float, float]:
    """Return how long to wait for a step that is due, and when the next one is; none is made up for."""
    return max(0.0, due_s - now_s), max(due_s, now_s) + PERIOD_S


class Field:
    """The turtles by name, and the paper under them."""

    def __init__(self, color: Color) -> None:
        """Begin without a turtle."""
        self.turtles: dict[str, Turtle] = {}
        self.paper = Paper(color)
        self._drawn: dict[str, Point] = {}  # the end of the line of each turtle
        self._count = 0

    def spawn(self, name: str, x: float, y: float, theta: float, now_s: float) -> str:
        """Add a turtle; return its name, which is chosen if it is empty."""
        check_numbers(x, y, theta)
        if not name:
            name = self._free_name()
        elif name in self.turtles:
            raise FieldError(f"A turtled named [{name}] already exists")
        elif not NAME.fullmatch(name):
            raise FieldError(f"[{name}] cannot name a turtle: take letters, digits and _")
        self.turtles[name] = Turtle(x, y, theta, now_s)
        self._drawn[name] = (x, y)
        return name

    def _free_name(self) -> str:
        while True:
            self._count += 1
            if f"turtle{self._count}" not in self.turtles:
                return f"turtle{self._count}"

    def kill(self, name: str) -> None:
        """Remove a turtle; its lines stay."""
        if name not in self.turtles:
            raise FieldError(f"Tried to kill turtle [{name}], which does not exist")
        del self.turtles[name], self._drawn[name]

    def reset(self, color: Color, now_s: float) -> str:
        """Have one new turtle in the middle of a blank paper; return its name."""
        self.turtles.clear()
        self._drawn.clear()
        self._count = 0
        self.paper.fill(color)
        return self.spawn("", *START, now_s)

    def set_pen(self, name: str, color: Color, width: int, off: int, now_s: float) -> None:
        """Lift the pen and leave it as it is, or put down one of a color and width [pixels]."""
        self._draw(name, now_s)
        pen = self.turtles[name].pen
        self.turtles[name].pen = (
            Pen(pen.color, pen.width, is_on=False) if off else Pen(color, width or 1)
        )

    def teleport_absolute(
        self, name: str, x: float, y: float, theta: float, now_s: float
    ) -> None:
        """Put a turtle elsewhere; a pen that is down draws the way."""
        self._draw(name, now_s)
        self.turtles[name].jump_to(x, y, theta)
        self._draw(name, now_s)

    def teleport_relative(self, name: str, linear: float, angular: float, now_s: float) -> None:
        """Turn a turtle, then put it ahead; a pen that is down draws the way."""
        self._draw(name, now_s)
        self.turtles[name].jump_by(linear, angular)
        self._draw(name, now_s)

    def step(self, now_s: float) -> list[State]:
        """Drive all turtles until now; return what they publish.

        As upstream's, a turtle sees the color before it draws there, and its linear velocity has no
        sign: a mimic of one that drives backwards drives forwards.
        """
        states = []
        for name, turtle in self.turtles.items():
            turtle.advance(now_s)
            outside = turtle.clamp()
            ahead, left, turn = turtle.velocity
            pose = (turtle.x, turtle.y, turtle.theta, math.hypot(ahead, left), turn)
            states.append(State(name, pose, self.paper.color_at(turtle.x, turtle.y), outside))
            self._draw(name, now_s)
        return states

    def _draw(self, name: str, now_s: float) -> None:
        """Drive a turtle until now, and draw its line up to there."""
        turtle, start = self.turtles[name], self._drawn[name]
        turtle.advance(now_s)
        end = self._drawn[name] = (turtle.x, turtle.y)
        if turtle.pen.is_on and start != end:
            self.paper.line(start, end, turtle.pen.color, turtle.pen.width)
