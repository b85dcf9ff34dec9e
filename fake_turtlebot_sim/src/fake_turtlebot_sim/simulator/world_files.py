"""Worlds as files: ours, or a map of map_server, whose occupied cells become walls."""

from __future__ import annotations

from math import tau
from pathlib import Path
from typing import Any, Callable

import numpy as np
import yaml

from fake_turtlebot_sim.simulator.grid_map import WorldError, read_map
from fake_turtlebot_sim.simulator.world import World
from node_kit.parameters import is_number

MOST_WALLS = 200_000


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
        raise WorldError(f"cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        mark, why = (getattr(error, name, None) for name in ("problem_mark", "problem"))
        where = f"line {mark.line + 1}: " if mark else ""
        raise WorldError(f"{where}not YAML: {why or 'no text'}") from None
    if not isinstance(data, dict):
        raise WorldError(f"must be a map of {', '.join(FIELDS)}, or of map_server")
    if "image" in data:
        return _from_map(path, data)
    found = {}
    for key, items in node.value:
        name, line = key.value, key.start_mark.line + 1
        if name not in FIELDS:
            known = ", ".join(FIELDS)
            raise WorldError(f"line {line}: {name}: is not known; known are {known}")
        allowed, read = FIELDS[name]
        found[name] = _read(read, data[name])
        if found[name] is None:
            if isinstance(data[name], list):  # the first of its items that is wrong
                wrong = [_read(read, [item]) is None for item in data[name]].index(True)
                line = items.value[wrong].start_mark.line + 1
            raise WorldError(f"line {line}: {name}: must be {allowed}")
    return World(**found)


def _read(read: Callable[[Any], Any], value: Any) -> Any:
    """Return what a value means, or None if it is not allowed."""
    try:
        return read(value)
    except (TypeError, ValueError, KeyError):
        return None


def _numbers(values: Any, count: int) -> Any:
    """Return as many numbers, as floats. Raises ValueError."""
    if len(values) != count or not all(map(is_number, values)):
        raise ValueError
    return tuple(map(float, values))


def _lines(value: Any, least: int) -> Any:
    if any(len(line) < least for line in value):
        raise ValueError
    return tuple(tuple(_numbers(point, 2) for point in line) for line in value)


def _named(value: Any, *names: str) -> Any:
    return _numbers([value[name] for name in names], len(value))


def _posts(value: Any) -> Any:
    if any(post["radius"] <= 0 for post in value):
        raise ValueError
    return tuple(_named(post, "x", "y", "radius") for post in value)


def _start(value: Any) -> Any:
    if abs(value["yaw"]) > tau:
        raise ValueError
    return _named(value, "x", "y", "yaw")


# What each must be, and what reads it.
FIELDS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "walls": ("a list of polylines [[x, y], [x, y], ...] in metres", lambda v: _lines(v, 2)),
    "posts": ("a list of {x: ..., y: ..., radius: ...} in metres, radius above 0", _posts),
    "cliffs": ("a list of polygons [[x, y], [x, y], [x, y], ...] in metres",
               lambda v: _lines(v, 3)),
    "start": ("{x: ..., y: ..., yaw: ...} in metres and radians, yaw from -2 pi to 2 pi", _start),
}  # fmt: skip


def _from_map(path: Path, about: dict[str, Any]) -> World:
    """Return the walls around the occupied cells of a map, and its start if it names one."""
    start = _read(_start, about.get("start"))
    if "start" in about and start is None:
        raise WorldError(f"start: must be {FIELDS['start'][0]}")
    grid = read_map(path, about)
    walls = grid.outlines()
    if len(walls) > MOST_WALLS:
        raise WorldError(f"{about['image']}: its outlines have more than {MOST_WALLS} pieces")
    ends = np.stack((walls.real, walls.imag), axis=-1).tolist()
    return World(tuple(((*one,), (*other,)) for one, other in ends), start=start, grid=grid)
