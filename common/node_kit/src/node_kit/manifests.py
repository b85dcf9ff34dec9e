"""The files package.xml of a workspace, and those that keep every ROS program from starting.

rospkg, and so rospy and roslaunch, reads all of them when it looks for any package; its error
names no file.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Iterator
from xml.etree import ElementTree

MOST_BYTES = 256 << 10  # Parsing takes ten times the memory.


def broken_manifests(folder: str | Path) -> list[tuple[str, str]]:
    """Return [(path, what is wrong)] of each package.xml below a folder that is unreadable."""
    complaints = ((str(path), _complaint(path)) for path in manifests(Path(folder)))
    return [(path, complaint) for path, complaint in complaints if complaint]


def manifests(folder: Path, above: frozenset[str] = frozenset()) -> Iterator[Path]:
    """Yield each package.xml below a folder, as rospkg finds them; above: folders around it."""
    here = os.path.realpath(folder)
    try:
        inside = {entry.name: entry for entry in os.scandir(folder)}
    except OSError:
        return
    if here in above or "CATKIN_IGNORE" in inside:
        return
    if "package.xml" in inside:
        yield folder / "package.xml"
        return  # rospkg looks no deeper than a package
    for name in sorted(inside):
        if os.path.isdir(inside[name].path):  # not is_dir(), which fails for a link to itself
            yield from manifests(folder / name, above | {here})


def _complaint(path: Path) -> str:
    try:
        if path.stat().st_size > MOST_BYTES:
            return f"larger than {MOST_BYTES >> 10} kB"
        name = ElementTree.parse(path).findtext("name")
    except (ElementTree.ParseError, OSError, ValueError, LookupError) as error:
        return str(error)
    return "" if name is not None else "it has no <name>"
