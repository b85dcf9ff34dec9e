"""World files: our format, or a map of map_server, whose occupied cells become walls."""

from __future__ import annotations

import os
from math import tau
from pathlib import Path
from typing import Any, Callable

import numpy as np
import yaml

from fake_turtlebot_sim.errors import WorldError
from fake_turtlebot_sim.simulator.grid_map import FARTHEST_M, Grid, check_file, read_map
from fake_turtlebot_sim.simulator.world import World
from node_kit.parameters.declaration import is_number

LARGEST_WORLD = 2_000_000  # bytes
MOST = {"walls": 40_000, "posts": 2_000, "cliffs": 1_000}  # corners, or posts
DEEPEST = 20  # levels of lists in lists
LIBRARY = Path(__file__).resolve().parents[1]
# The package's folder of worlds: where it is built, and where it is installed.
FOLDERS = (LIBRARY.parents[1] / "worlds", LIBRARY.parents[3] / "share" / LIBRARY.name / "worlds")
# libyaml is ten times as fast as PyYAML alone.
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def find_world(name: str) -> Path:
    """Return the path of a world, given as a path or by its name in this package."""
    if "/" in name or "." in name:
        # roslaunch starts nodes in another folder than the user's
        return Path(os.environ.get("PWD", ""), os.path.expanduser(name))
    worlds = shipped_worlds()
    if name not in worlds:
        names = ", ".join(sorted(worlds))
        raise WorldError(f"no world of this package has that name: take {names} or a file")
    return worlds[name]


def shipped_worlds() -> dict[str, Path]:
    """Return the worlds of this package by name."""
    return {path.stem: path for folder in FOLDERS for path in folder.glob("*.yaml")}


def read_world(path: Path) -> World:
    """Return the World of a YAML file in our format or map_server's. Raises WorldError."""
    node, data = _parsed(path)
    if not isinstance(data, dict):
        raise WorldError(f"must be a map of {', '.join(FIELDS)}, or of map_server")
    if "image" in data:
        return _from_map(path, data)
    fields = {}
    for key, items in reversed(node.value):  # of duplicate keys, data has the last
        name, line = key.value, key.start_mark.line + 1
        if name not in FIELDS:
            known = ", ".join(FIELDS)
            raise WorldError(f"line {line}: {name}: is unknown; known are {known}")
        if name in fields:
            raise WorldError(f"line {line}: {name}: is listed twice")
        allowed, read = FIELDS[name]
        value = data.get(name)
        fields[name] = _read(read, value)
        if fields[name] is None:
            if isinstance(value, list):  # name the line of its first wrong item
                wrong = [_read(read, [item]) is None for item in value].index(True)
                line = items.value[wrong].start_mark.line + 1
            raise WorldError(f"line {line}: {name}: must be {allowed}, up to {FARTHEST_M:g} m")
        count = sum(1 if name == "posts" else np.size(item) // 2 for item in fields[name])
        if count > MOST.get(name, 3):
            raise WorldError(f"line {line}: {name}: {count} are too many: at most {MOST[name]}")
    return World(**fields)


def read_grid(path: Path) -> Grid:
    """Return the Grid of a map of map_server, a YAML file. Raises WorldError."""
    _, data = _parsed(path)
    if not isinstance(data, dict) or "image" not in data:
        raise WorldError("must be a map of map_server, with image:")
    return read_map(path, data)


def _parsed(path: Path) -> tuple[Any, Any]:
    """Return (node, value) of the YAML in a file, None for an empty one. Raises WorldError."""
    try:
        check_file(path, LARGEST_WORLD)
        text = path.read_text(encoding="utf-8")
        depth = 0
        for event in yaml.parse(text, Loader=LOADER):
            depth += isinstance(event, yaml.CollectionStartEvent)
            depth -= isinstance(event, yaml.CollectionEndEvent)
            if depth > DEEPEST or isinstance(
                event, yaml.AliasEvent
            ):  # aliases could expand without end
                where = f"line {event.start_mark.line + 1}"
                raise WorldError(f"{where}: *NAME, or more than {DEEPEST} lists in each other")
        loader = LOADER(text)
        node = loader.get_single_node()
        return node, loader.construct_document(node) if node else None
    except OSError as error:
        raise WorldError(f"cannot be read: {error.strerror}") from None
    except WorldError:
        raise
    except Exception as error:  # PyYAML raises ValueError, KeyError and more
        mark, why = (getattr(error, name, None) for name in ("problem_mark", "problem"))
        where = f"line {mark.line + 1}: " if mark else ""
        raise WorldError(f"{where}not YAML: {why or 'not text, or an invalid value'}") from None


def _read(read: Callable[[Any], Any], value: Any) -> Any:
    """Return the converted value, or None if it is not allowed."""
    try:
        return read(value)
    except (TypeError, ValueError, KeyError):
        return None


def _numbers(values: Any, count: int) -> Any:
    """Return `count` numbers as floats. Raises ValueError."""
    if len(values) != count or not all(is_number(v) and abs(v) <= FARTHEST_M for v in values):
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


# Each field: the allowed values, and the function that reads them.
FIELDS: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "walls": ("a list of polylines [[x, y], [x, y], ...] in metres", lambda v: _lines(v, 2)),
    "posts": ("a list of {x: ..., y: ..., radius: ...} in metres, radius above 0", _posts),
    "cliffs": ("a list of polygons [[x, y], [x, y], [x, y], ...] in metres",
               lambda v: _lines(v, 3)),
    "start": ("{x: ..., y: ..., yaw: ...} in metres and radians, yaw from -2 pi to 2 pi", _start),
}  # fmt: skip


def _from_map(path: Path, about: dict[str, Any]) -> World:
    """Return the World of a map: walls around occupied cells, and the start if it names one."""
    start = _read(_start, about.get("start"))
    if "start" in about and start is None:
        raise WorldError(f"start: must be {FIELDS['start'][0]}")
    grid = read_map(path, about)
    walls = grid.outlines()
    ends = np.stack((walls.real, walls.imag), axis=-1).tolist()
    return World(tuple(((*a,), (*b,)) for a, b in ends), start=start, grid=grid)
