"""Maps of map_server: their cells, their walls, and places with room for a robot.

The rules are those of map_server's main.cpp and image_loader.cpp.
"""

from __future__ import annotations

from cmath import rect
from contextlib import suppress
from dataclasses import dataclass
from errno import EFBIG
from functools import cached_property
from pathlib import Path
from stat import S_ISREG
from typing import Any, Mapping

import numpy as np

from fake_turtlebot_sim.errors import WorldError
from fake_turtlebot_sim.simulator.differential_drive import Pose
from fake_turtlebot_sim.simulator.map_images import read_pixels

OCCUPIED, UNKNOWN = 100, -1  # as in nav_msgs/OccupancyGrid; 0: free
LARGEST_IMAGE = 100_000_000  # bytes
MOST_WALLS = 200_000  # pieces of outlines
FARTHEST_M = 1e4  # from (0, 0); beyond it, positions round to more than contact.TOUCH_M
TRINARY, SCALE, RAW = MODES = ("trinary", "scale", "raw")


@dataclass(frozen=True, eq=False)
class Grid:
    """cells: (rows, columns) of int8, the lowest row first; resolution [m]; origin [m, rad]."""

    cells: Any
    resolution: float
    origin: Pose

    @cached_property
    def occupied(self) -> Any:
        """The cells that are walls: 100 to 254, read without a sign, as in costmap_2d."""
        return (self.cells < UNKNOWN) | (self.cells >= OCCUPIED)

    def is_occupied(self, x: float, y: float) -> bool:
        """Return whether (x, y) [m] is in an occupied cell."""
        at = (complex(x, y) - complex(*self.origin[:2])) * rect(1.0, -self.origin[2])
        column, row = int(at.real // self.resolution), int(at.imag // self.resolution)
        rows, columns = self.cells.shape
        return 0 <= row < rows and 0 <= column < columns and bool(self.occupied[row, column])

    def places(self, columns: Any, rows: Any) -> Any:
        """Return positions given in cells, as x + 1j y [m]."""
        away = (columns + 1j * rows) * self.resolution
        return away * rect(1.0, self.origin[2]) + complex(*self.origin[:2])

    def outlines(self) -> Any:
        """Return the edges of occupied cells, joined in line: (n, 2) [m]. Raises WorldError."""
        segments = []
        for is_upright in (False, True):
            cells = self.occupied.T if is_upright else self.occupied
            edge = np.diff(np.pad(cells, ((1, 1), (0, 0))).astype(np.int8), axis=0) != 0
            steps = np.diff(np.pad(edge, ((0, 0), (1, 1))).astype(np.int8), axis=1)
            if np.count_nonzero(steps > 0) > MOST_WALLS:
                raise WorldError(f"its walls have more than {MOST_WALLS} pieces")
            (rows, begins), (_, ends) = np.nonzero(steps > 0), np.nonzero(steps < 0)
            lines = np.array([[begins, rows], [ends, rows]])
            segments.append(lines[:, ::-1] if is_upright else lines)
        ends = np.concatenate(segments, axis=2)
        return self.places(ends[:, 0], ends[:, 1]).T

    def free_place(self, radius: float) -> Pose:
        """Return the centre of the cell nearest to (0, 0) around which a disc [m] has room.

        The disc covers only known cells; if no such place exists, only the cell at its centre must
        be known. Raises ValueError if no place has room.
        """
        is_free = (self.cells >= 0) & (self.cells < OCCUPIED)
        reach, (rows, columns) = int(radius / self.resolution + 0.5), self.cells.shape
        away = np.maximum(np.abs(np.arange(-reach, reach + 1)) - 0.5, 0.0) * self.resolution
        # For each column of the disc: how many cells it covers above and below its centre, or -1.
        heights = ((np.hypot(away[:, None], away) < radius).sum(axis=0) - 1) // 2
        for is_open in (is_free, ~self.occupied):
            fits, around = is_free.copy(), np.pad(is_open, reach)
            upright = around[reach : reach + rows].copy()  # open from -height to height
            for height in range(reach + 1):
                above, below = reach + height, reach - height
                upright &= around[above : above + rows] & around[below : below + rows]
                for column in np.flatnonzero(heights == height):
                    fits &= upright[:, column : column + columns]
            nearest, strip = [], rows // 64 + 1  # strips bound the memory
            for low in range(0, rows, strip):
                lines, across = np.nonzero(fits[low : low + strip])
                if len(lines):
                    places = self.places(across + 0.5, lines + low + 0.5)
                    nearest.append(places[np.abs(places).argmin()])
            if nearest:
                place = min(nearest, key=abs)
                return float(place.real), float(place.imag), 0.0
        raise ValueError("the map has no free place where a robot has room")


def check_file(path: Path, most: int) -> None:
    """Raise OSError if the path is not a plain file, or has more than `most` bytes."""
    about = path.stat()
    if not S_ISREG(about.st_mode) or about.st_size > most:
        raise OSError(EFBIG, f"not a plain file of at most {most // 10**6} MB")


def read_map(path: Path, about: Mapping[str, Any]) -> Grid:
    """Return the Grid of a map, given the path of its YAML file and the values in it.

    Raises WorldError.
    """
    mode, origin, negate = about.get("mode", TRINARY), about.get("origin"), about.get("negate")
    if mode not in MODES:
        raise WorldError(f"mode: must be {', '.join(MODES)} or left out")
    if str(negate) not in {"0", "1"}:
        raise WorldError("negate: must be 0 or 1")
    if not isinstance(origin, list) or len(origin) < 3:
        raise WorldError("origin: must be [x, y, yaw] in metres and radians")
    x, y, yaw = (
        _number({"origin": part}, "origin", -FARTHEST_M, FARTHEST_M) for part in origin[:3]
    )
    resolution = _number(about, "resolution", 0.001, 100.0)
    occupied, free = (_number(about, name, 0.0, 1.0) for name in ("occupied_thresh", "free_thresh"))
    image = path.parent / str(about["image"])
    try:
        check_file(image, LARGEST_IMAGE)
        pixels, has_alpha = read_pixels(image.read_bytes())
    except ImportError:
        raise WorldError(f"{image}: needs Pillow: apt install python3-pil") from None
    except Exception as error:  # Pillow raises struct.error and more
        why = getattr(error, "strerror", None) or error
        raise WorldError(f"{image}: cannot be read as an image: {why}") from None
    if np.hypot(x, y) + np.hypot(*pixels.shape[:2]) * resolution > FARTHEST_M:
        raise WorldError(f"{image}: extends farther than {FARTHEST_M:g} m from (0, 0)")
    channels = pixels.shape[2]
    counted = channels - (has_alpha and mode != TRINARY)
    mean = np.arange(255 * counted + 1) / counted  # for each sum of the channels
    table = _values(255 - mean if str(negate) == "1" else mean, mode, occupied, free)
    cells = table[pixels[..., :counted].sum(axis=2, dtype=np.uint16)]
    if mode == SCALE and channels > 1:  # map_server takes the last channel as alpha, whatever it is
        cells[(cells > 0) & (cells < OCCUPIED) & (pixels[..., -1] == 0)] = UNKNOWN
    return Grid(cells[::-1], resolution, (x, y, yaw))


def _number(about: Mapping[str, Any], name: str, least: float, most: float) -> float:
    """Return a number in a map's file, which may be a text, as in yaml-cpp. Raises WorldError."""
    if name not in about:
        raise WorldError(f"{name}: is missing; a map needs it")
    with suppress(ValueError):
        value = float(str(about[name]))
        if least <= value <= most:
            return value
    raise WorldError(f"{name}: {about[name]!r:.40}: must be a number from {least:g} to {most:g}")


def _values(shades: Any, mode: str, occupied: float, free: float) -> Any:
    """Return the cells' values for shades from 0 to 255, by the two thresholds."""
    if mode == RAW:
        return shades.astype(np.uint8).view(np.int8)
    share = (255 - shades) / 255.0
    between = 1 + 98 * (share - free) / (occupied - free or 1.0) if mode == SCALE else UNKNOWN
    values = np.where(share > occupied, OCCUPIED, np.where(share < free, 0, between))
    return values.astype(np.int8)
