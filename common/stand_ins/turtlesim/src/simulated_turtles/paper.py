"""The pixels that turtles draw on, and the shape of a turtle in a window (pure)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from simulated_turtles.turtle import FIELD_M, Color, Point

SIZE = 500  # [pixels]
PIXELS_PER_M = 45
# A turtle as a polygon: (ahead, left) [pixels].
LEFT = ((22, 0), (15, 5), (13, 14), (7, 11), (-9, 11), (-16, 14), (-20, 0))
SHAPE = (*LEFT, *((ahead, -left) for ahead, left in LEFT[:0:-1]))


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

    def __init__(self) -> None:
        """Begin with black."""
        self._pixels = np.zeros((SIZE, SIZE, 3), np.uint8)

    def fill(self, background: Color) -> None:
        """Have one color everywhere."""
        self._pixels[:] = background
        self._changed = [(0, 0, SIZE, SIZE)]  # left, top, right, bottom

    def color_at(self, x: float, y: float) -> Color:
        """Return the color of a place [m] in the field."""
        column, row = (min(max(round(value), 0), SIZE - 1) for value in pixel(x, y))
        red, green, blue = map(int, self._pixels[row, column])
        return red, green, blue

    def line(self, start: Point, end: Point, color: Color, width: int) -> None:
        """Draw a line of a width [pixels] between two places [m], which may be outside."""
        (x0, y0), (x1, y1), reach = pixel(*start), pixel(*end), max(width, 1.5) / 2
        left, top = (max(math.floor(min(x) - reach), 0) for x in ((x0, x1), (y0, y1)))
        right, bottom = (min(math.ceil(max(x) + reach) + 1, SIZE) for x in ((x0, x1), (y0, y1)))
        if left >= right or top >= bottom:
            return
        rows, columns = np.mgrid[top:bottom, left:right]
        dx, dy = x1 - x0, y1 - y0
        along = ((columns - x0) * dx + (rows - y0) * dy) / (dx * dx + dy * dy or 1.0)
        along = np.clip(along, 0.0, 1.0)
        is_near = np.hypot(columns - x0 - along * dx, rows - y0 - along * dy) <= reach
        self._pixels[top:bottom, left:right][is_near] = color
        self._changed.append((left, top, right, bottom))

    def take_changes(self) -> tuple[int, int, bytes] | None:
        """Return (column, row, a PPM image) of what changed since the last call, or None."""
        if not self._changed:
            return None
        sides = list(zip(*self._changed))
        (left, top), (right, bottom) = map(min, sides[:2]), map(max, sides[2:])
        self._changed.clear()
        block: Any = self._pixels[top:bottom, left:right]
        return left, top, b"P6 %d %d 255\n" % (right - left, bottom - top) + block.tobytes()
