"""The pixels that turtles draw on, and the shape of a turtle in a window (pure)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from simulated_turtles.turtle import FIELD_M, Color, Point

SIZE = 500  # [pixels]
PIXELS_PER_M = 45
# A turtle as a polygon: (ahead, left) [pixels].
SHAPE = ((22, 0), (15, 5), (13, 14), (7, 11), (-9, 11), (-16, 14), (-20, 0))
SHAPE += tuple((ahead, -left) for ahead, left in SHAPE[:0:-1])


def pixel(x: float, y: float) -> tuple[float, float]:
    """Return (column, row), not rounded, of a place [m]."""
    return x * PIXELS_PER_M, (FIELD_M - y) * PIXELS_PER_M


def outline(x: float, y: float, theta: float) -> list[float]:
    """Return column, row, column, ... of a turtle's polygon."""
    (column, row), cos, sin = pixel(x, y), math.cos(theta), math.sin(theta)
    corners = [
        (column + ahead * cos - left * sin, row - ahead * sin - left * cos) for ahead, left in SHAPE
    ]
    return [value for corner in corners for value in corner]


class Paper:
    """SIZE x SIZE pixels, and which of them changed."""

    def __init__(self, background: Color) -> None:
        """Begin with a blank one."""
        self._pixels = np.empty((SIZE, SIZE, 3), np.uint8)
        self.fill(background)

    def fill(self, background: Color) -> None:
        """Have one color everywhere."""
        self._pixels[:] = background
        self._changed = (0, 0, SIZE, SIZE)  # columns from, rows from, columns to, rows to

    def color_at(self, x: float, y: float) -> Color:
        """Return the color of a place [m] in the field."""
        column, row = (min(max(round(value), 0), SIZE - 1) for value in pixel(x, y))
        return tuple(int(value) for value in self._pixels[row, column])

    def line(self, start: Point, end: Point, color: Color, width: int) -> None:
        """Draw a line of a width [pixels] between two places [m], which may be outside."""
        (x0, y0), (x1, y1), reach = pixel(*start), pixel(*end), max(width, 1.5) / 2
        left, top = (max(math.floor(min(pair) - reach), 0) for pair in ((x0, x1), (y0, y1)))
        right, bottom = (
            min(math.ceil(max(pair) + reach) + 1, SIZE) for pair in ((x0, x1), (y0, y1))
        )
        if left >= right or top >= bottom:
            return
        rows, columns = np.mgrid[top:bottom, left:right]
        dx, dy = x1 - x0, y1 - y0
        length2 = dx * dx + dy * dy or 1.0
        along = np.clip(((columns - x0) * dx + (rows - y0) * dy) / length2, 0.0, 1.0)
        is_near = (columns - x0 - along * dx) ** 2 + (rows - y0 - along * dy) ** 2 <= reach**2
        self._pixels[top:bottom, left:right][is_near] = color
        before = self._changed or (left, top, right, bottom)
        self._changed = (
            min(left, before[0]), min(top, before[1]), max(right, before[2]), max(bottom, before[3])
        )  # fmt: skip

    def take_changes(self) -> tuple[int, int, bytes] | None:
        """Return (column, row, a PPM image) of what changed since the last call; None if nothing."""
        if not self._changed:
            return None
        (left, top, right, bottom), self._changed = self._changed, ()
        block: Any = self._pixels[top:bottom, left:right]
        return left, top, b"P6 %d %d 255\n" % (right - left, bottom - top) + block.tobytes()
