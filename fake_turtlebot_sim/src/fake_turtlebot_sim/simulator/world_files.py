"""Worlds as files: ours, or a map of map_server, whose occupied cells become walls."""

from __future__ import annotations

from math import cos, isfinite, sin
from pathlib import Path
from typing import Any, Callable

import numpy as np
import yaml

from fake_turtlebot_sim.simulator.world import Point, World

LARGEST_MAP = 4_000_000  # cells
MOST_WALLS = 20_000


class WorldError(Exception):
    """Why a file is no world: one line, with the line of the file and what is allowed."""


def find_world(name: str) -> Path:
    """Return the path of a world, given as a file or by the name of one of this package."""
    if "/" in name or name.endswith((".yaml", ".yml")):
        return Path(name).expanduser()
    worlds = shipped_worlds()
    if name not in worlds:
        names = ", ".join(sorted(worlds))
        raise WorldError(f"no world of this package has that name: take {names} or a file")
    return worlds[name]


def shipped_worlds() -> dict[str, Path]:
    """Return the worlds of this package by name."""
    import rospkg  # noqa: PLC0415  the only ROS here

    folder = Path(rospkg.RosPack().get_path("fake_turtlebot_sim")) / "worlds"
    return {path.stem: path for path in folder.glob("*.yaml")}


def read_world(path: Path) -> World:
    """Return the World of a YAML file, ours or map_server's. Raises WorldError."""
    try:
        text = path.read_text(encoding="utf-8")
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        data = yaml.safe_load(text)
    except OSError as error:
        raise WorldError(f"{path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        mark = getattr(error, "problem_mark", None)
        where = f", line {mark.line + 1}" if mark else ""
        why = getattr(error, "problem", None) or "no text"
        raise WorldError(f"{path}{where}: no YAML: {why}") from None
    if isinstance(data, dict) and "image" in data:
        return _from_map(path, data)
    if not isinstance(data, dict):
        raise WorldError(f"{path}: must be a map of {', '.join(FIELDS)}, or of map_server")
    lines = {key.value: key.start_mark.line + 1 for key, _ in node.value}
    found = {}
    for name, value in data.items():
        if name not in FIELDS:
            allowed = f"is not known; known are {', '.join(FIELDS)}"
            raise WorldError(f"{path}, line {lines.get(name, 1)}: {name}: {allowed}")
        try:
            found[name] = FIELDS[name][1](value)
        except (TypeError, ValueError, KeyError):
            where = f"{path}, line {lines[name]}"
            raise WorldError(f"{where}: {name}: must be {FIELDS[name][0]}") from None
    return World(**found)


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        raise ValueError
    return float(value)


def _point(value: Any) -> Point:
    x, y = value
    return _number(x), _number(y)


def _lines(value: Any, least: int = 2) -> tuple[tuple[Point, ...], ...]:
    found = tuple(tuple(map(_point, line)) for line in value)
    if any(len(line) < least for line in found):
        raise ValueError
    return found


def _fields(value: Any, *names: str) -> tuple[float, ...]:
    if set(value) - set(names):
        raise ValueError
    return tuple(_number(value[name]) for name in names)


def _posts(value: Any) -> Any:
    found = tuple(_fields(post, "x", "y", "radius") for post in value)
    if any(radius <= 0 for _, _, radius in found):
        raise ValueError
    return found


# What each must be, and what reads it.
FIELDS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "walls": ("a list of polylines [[x, y], [x, y], ...] in metres", _lines),
    "posts": ("a list of {x: ..., y: ..., radius: ...} in metres", _posts),
    "cliffs": ("a list of polygons [[x, y], [x, y], [x, y], ...] in metres",
               lambda value: _lines(value, 3)),
    "start": ("{x: ..., y: ..., yaw: ...} in metres and radians",
              lambda value: _fields(value, "x", "y", "yaw")),
}  # fmt: skip


def _from_map(path: Path, about: dict[str, Any]) -> World:
    """Return the walls around the occupied cells of a map; its rows begin at the top."""
    from PIL import Image  # noqa: PLC0415  a quarter of the node's start, and for maps alone

    image = path.parent / str(about["image"])
    try:
        resolution = _number(about["resolution"])
        x, y, yaw = map(_number, about["origin"])
        threshold = _number(about.get("occupied_thresh", 0.65))
        is_negative = bool(about.get("negate", 0))
    except (TypeError, ValueError, KeyError):
        needs = "resolution [m], origin [x, y, yaw] and occupied_thresh, as map_server has them"
        raise WorldError(f"{path}: a map needs {needs}") from None
    try:
        with Image.open(image) as picture:
            if picture.width * picture.height > LARGEST_MAP:
                raise WorldError(f"{image}: more than {LARGEST_MAP} cells")
            shades = np.asarray(picture.convert("L"), dtype=float)[::-1]
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise WorldError(f"{image}: cannot be read as an image: {error}") from None
    occupied = (shades if is_negative else 255.0 - shades) / 255.0 > threshold
    ends = np.array(_outlines(occupied), dtype=float).reshape(-1, 2) * resolution
    if len(ends) > 2 * MOST_WALLS:
        raise WorldError(f"{image}: its outlines have more than {MOST_WALLS} pieces")
    turned = ends @ np.array([[cos(yaw), sin(yaw)], [-sin(yaw), cos(yaw)]]) + (x, y)
    points = [(float(px), float(py)) for px, py in turned]
    return World(tuple(zip(points[::2], points[1::2])))


def _outlines(occupied: Any) -> list[tuple[int, int, int, int]]:
    """Return the edges between occupied and free cells, x1, y1, x2, y2, joined where in line."""
    found = []
    for is_upright in (False, True):
        cells = occupied.T if is_upright else occupied
        edge = np.diff(np.pad(cells, ((1, 1), (0, 0))).astype(np.int8), axis=0) != 0
        steps = np.diff(np.pad(edge, ((0, 0), (1, 1))).astype(np.int8), axis=1)
        for (row, begin), (_, end) in zip(np.argwhere(steps > 0), np.argwhere(steps < 0)):
            line = (begin, row, end, row)
            found.append((row, begin, row, end) if is_upright else line)
    return found
