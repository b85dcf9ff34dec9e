"""The field with its turtles: upstream's services as rules (pure; time is an argument)."""

from __future__ import annotations

import itertools
import math
import re
from typing import Any, Callable, NamedTuple

from simulated_turtles.paper import Paper
from simulated_turtles.turtle import Color, Pen, Point, Turtle

PERIOD_S = 0.016  # 62.5 Hz
BACKGROUND = {"background_r": 69, "background_g": 86, "background_b": 255}
START = (5.5444446, 5.5444446, 0.0)  # the middle, FIELD_M / 2, as a float32 has it
NAME = re.compile(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", re.ASCII)


class State(NamedTuple):
    """What a turtle publishes; `outside` is where it hit the wall, with y from the top."""

    name: str
    pose: tuple[float, float, float, float, float]  # in the order of turtlesim/Pose
    color: Color
    outside: Point | None


def background(given: dict[str, Any]) -> Color:
    """Return the color of parameters; the default for what is no integer, as upstream."""
    values = ((given.get(name, default), default) for name, default in BACKGROUND.items())
    red, green, blue = (one & 255 if isinstance(one, int) else other for one, other in values)
    return red, green, blue


def wait_s(due_s: float, now_s: float) -> tuple[float, float]:
    """Return how long to wait for a step, and when the next one is due; a late one delays all."""
    return max(0.0, due_s - now_s), max(due_s, now_s) + PERIOD_S


class Field:
    """The turtles by name, and the paper under them."""

    def __init__(self, color: Color) -> None:
        """Begin without a turtle."""
        self.paper = Paper()
        self.reset(color)

    def reset(self, color: Color) -> None:
        """Have a blank paper of a color, and no turtle; the next one is turtle1."""
        self.turtles: dict[str, Turtle] = {}
        self._names = map("turtle{}".format, itertools.count(1))
        self.paper.fill(color)

    def spawn(self, name: str, x: float, y: float, theta: float, now_s: float) -> str:
        """Add a turtle; return its name, which is chosen if it is empty."""
        if name in self.turtles:
            raise ValueError(f"A turtled named [{name}] already exists")  # upstream's words
        if name and not NAME.fullmatch(name):
            raise ValueError(f"[{name}] cannot name a turtle: take letters, digits and _")
        turtle = Turtle(x, y, theta, now_s)
        name = name or next(one for one in self._names if one not in self.turtles)
        self.turtles[name] = turtle
        return name

    def kill(self, name: str) -> None:
        """Remove a turtle; its lines stay."""
        if not self.turtles.pop(name, None):
            raise ValueError(f"Tried to kill turtle [{name}], which does not exist")

    def set_pen(self, turtle: Turtle, color: Color, width: int, off: int, now_s: float) -> None:
        """Lift the pen and leave it as it is, or put down one of a color and width [pixels]."""
        turtle.advance(now_s)
        self._draw(turtle)
        turtle.pen = turtle.pen._replace(is_on=False) if off else Pen(color, width or 1)

    def teleport(self, turtle: Turtle, jump: Callable[[], None], now_s: float) -> None:
        """Have a turtle jump; a pen that is down draws the way."""
        turtle.advance(now_s)
        self._draw(turtle)
        jump()
        self._draw(turtle)

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
            self._draw(turtle)
        return states

    def _draw(self, turtle: Turtle) -> None:
        """Draw the line of a turtle up to where it is."""
        start, end = turtle.drawn, (turtle.x, turtle.y)
        if turtle.pen.is_on and start != end:
            self.paper.line(start, end, turtle.pen.color, turtle.pen.width)
        turtle.drawn = end
