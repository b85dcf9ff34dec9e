"""Maps as map_server reads them, their walls, and where in them a robot has room (pure, numpy).

The rules are those of map_server's main.cpp and image_loader.cpp, and of SDL_image below them.
"""

from __future__ import annotations

from cmath import rect
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from fake_turtlebot_sim.simulator.differential_drive import Pose

OCCUPIED, UNKNOWN = 100, -1  # nav_msgs/OccupancyGrid; 0: free
LARGEST_MAP = 4096 * 4096  # cells
TRINARY, SCALE, RAW = MODES = ("trinary", "scale", "raw")


class WorldError(ValueError):
    """Why a file is no world: its line and what is allowed, in one line without the path."""


@dataclass(frozen=True, eq=False)
class Grid:
    """cells: (rows, columns) of int8, the lowest row first; resolution [m]; origin [m, rad]."""

    cells: Any
    resolution: float
    origin: Pose

    @cached_property
    def occupied(self) -> Any:
        """Which cells are walls: from 100 to 254, as costmap_2d reads them, without a sign."""
        return (self.cells < UNKNOWN) | (self.cells >= OCCUPIED)

    def is_occupied(self, x: float, y: float) -> bool:
        """Return whether (x, y) [m] is in an occupied cell."""
        at = (complex(x, y) - complex(*self.origin[:2])) * rect(1.0, -self.origin[2])
        column, row = int(at.real // self.resolution), int(at.imag // self.resolution)
        rows, columns = self.cells.shape
        return 0 <= row < rows and 0 <= column < columns and bool(self.occupied[row, column])

    def places(self, columns: Any, rows: Any) -> Any:
        """Return places in the map, counted in cells, as x + 1j y [m]."""
        away = (columns + 1j * rows) * self.resolution
        return away * rect(1.0, self.origin[2]) + complex(*self.origin[:2])

    def outlines(self) -> Any:
        """Return the edges between occupied and other cells, joined where in line: (n, 2) [m]."""
        found = []
        for is_upright in (False, True):
            cells = self.occupied.T if is_upright else self.occupied
            edge = np.diff(np.pad(cells, ((1, 1), (0, 0))).astype(np.int8), axis=0) != 0
            steps = np.diff(np.pad(edge, ((0, 0), (1, 1))).astype(np.int8), axis=1)
            (rows, begins), (_, ends) = np.nonzero(steps > 0), np.nonzero(steps < 0)
            lines = np.array([[begins, rows], [ends, rows]])
            found.append(lines[:, ::-1] if is_upright else lines)
        ends = np.concatenate(found, axis=2)
        return self.places(ends[:, 0], ends[:, 1]).T

    def free_place(self, radius: float) -> Pose:
        """Return the middle of the cell nearest to (0, 0) around which a disc [m] has room.

        It covers known cells or, if it can not, has a known one in its middle. Raises ValueError.
        """
        is_free = (self.cells >= 0) & (self.cells < OCCUPIED)
        reach, (rows, columns) = int(radius / self.resolution + 0.5), self.cells.shape
        away = np.maximum(np.abs(np.arange(-reach, reach + 1)) - 0.5, 0.0) * self.resolution
        covered = np.argwhere(np.hypot(away[:, None], away) < radius)
        for is_open in (is_free, ~self.occupied):
            fits, around = is_free.copy(), np.pad(is_open, reach)
            for row, column in covered:
                fits &= around[row : row + rows, column : column + columns]
            if fits.any():
                places = self.places(*(np.argwhere(fits).T[::-1] + 0.5))
                place = places[np.abs(places).argmin()]
                return float(place.real), float(place.imag), 0.0
        raise ValueError("the map has no free place where a robot has room")


def read_map(path: Path, about: Mapping[str, Any]) -> Grid:
    """Return the Grid of a map, of its YAML file and what stands in it. Raises WorldError."""
    try:
        mode = MODES[MODES.index(about.get("mode", TRINARY))]
        negate = int(str(about["negate"]))  # of true or a text as yaml-cpp does
        lengths = about["resolution"], *about["origin"][:3]
        given = (*lengths, about["occupied_thresh"], about["free_thresh"])
        resolution, x, y, yaw, occupied, free = numbers = [float(str(one)) for one in given]
        if resolution <= 0 or not all(map(isfinite, numbers)):
            raise ValueError(f"{numbers}")
    except (KeyError, TypeError, ValueError) as error:
        needs = "resolution, origin [x, y, yaw], negate (0 or 1), occupied_thresh, free_thresh"
        raise WorldError(f"a map needs {needs} and mode {MODES} or none: {error}") from None
    image = path.parent / str(about["image"])
    try:
        pixels = _pixels(image)
    except ImportError:
        raise WorldError(f"{image}: reading it takes Pillow: apt install python3-pil") from None
    except (OSError, SyntaxError, ValueError) as error:
        raise WorldError(f"{image}: cannot be read as an image: {error}") from None
    channels = pixels.shape[2]
    counted = channels - (channels == 4 and mode != TRINARY)  # without alpha
    mean = np.arange(255 * counted + 1) / counted  # of each sum that the channels can have
    table = _values(255 - mean if negate else mean, mode, occupied, free)
    cells = table[pixels[..., :counted].sum(axis=2, dtype=np.uint16)]
    if mode == SCALE and channels > 1:  # the last channel counts as alpha, whichever it is
        cells[(cells > 0) & (cells < OCCUPIED) & (pixels[..., -1] == 0)] = UNKNOWN
    return Grid(cells[::-1], resolution, (x, y, yaw))


def _values(shades: Any, mode: str, occupied: float, free: float) -> Any:
    """Return the values of cells, of their shades from 0 to 255 and the two thresholds."""
    if mode == RAW:
        return shades.astype(np.uint8).view(np.int8)
    share = (255 - shades) / 255.0
    between = 1 + 98 * (share - free) / (occupied - free or 1.0) if mode == SCALE else UNKNOWN
    values = np.where(share > occupied, OCCUPIED, np.where(share < free, 0, between))
    return values.astype(np.int8)


def _pixels(image: Path) -> Any:
    """Return the bytes of an image's pixels as SDL_image has them: (rows, columns, channels)."""
    from PIL import Image  # noqa: PLC0415  a quarter of the node's start, and for maps alone

    Image.MAX_IMAGE_PIXELS = None  # it is checked here
    with Image.open(image) as picture:
        if picture.width * picture.height > LARGEST_MAP:
            raise ValueError(f"more than {LARGEST_MAP} cells")
        kinds = {"1": "L", "F": "L", "LA": "RGBA", "PA": "RGBA", "CMYK": "RGB"}
        if isinstance(picture.info.get("transparency"), bytes):
            kinds["P"] = "RGBA"  # else the number of the colour counts
        pixels = np.asarray(picture.convert(kinds.get(picture.mode, picture.mode)))
    if pixels.dtype != np.uint8:  # of 16 bits the higher 8
        pixels = (pixels >> 8).astype(np.uint8)
    return pixels.reshape(*pixels.shape[:2], -1)
