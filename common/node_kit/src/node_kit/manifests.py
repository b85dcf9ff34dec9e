"""Finds the package.xml files of a workspace, and broken ones, which stop every ROS program.

rospkg, and so rospy and roslaunch, reads all of them to find one package; its error names no file.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Iterator
from xml.etree import ElementTree

MOST_BYTES = 256 << 10  # parsing takes ten times as much memory


def broken_manifests(folder: str | Path) -> list[tuple[str, str]]:
    """Return [(path, error)] of each unreadable package.xml below a folder."""
    complaints = ((str(path), _complaint(path)) for path in manifests(Path(folder)))
    return [(path, complaint) for path, complaint in complaints if complaint]


def manifests(folder: Path, above: frozenset[str] = frozenset()) -> Iterator[Path]:
    """Yield each package.xml below a folder, as rospkg does. above: real paths of its parents."""
    here = os.path.realpath(folder)
    try:
        inside = {entry.name: entry for entry in os.scandir(folder)}
    except OSError:
        return
    if here in above or "CATKIN_IGNORE" in inside:
        return
    if "package.xml" in inside:
        yield folder / "package.xml"
        return  # rospkg does not look inside a package
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
