"""Every package.xml of the workspace: a fault in one stops the other packages, too."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Sequence

from node_kit.manifests import broken_manifests
from tutorial_check.checking.causes import explained
from tutorial_check.checking.model import Wrong
from tutorial_check.submission.launch_xml import place_of, read
from tutorial_check.submission.student_files import TOO_LARGE
from tutorial_check.submission.workspace import Package

# The real ones may well be in a student's src.
STAND_INS = Path(__file__).resolve().parents[5] / "common/stand_ins"


def is_stand_in(name: str) -> bool:
    """Return whether the suite's package of that name stands in for the one that Debian lacks."""
    return (STAND_INS / name / "package.xml").is_file()


def unreadable(package: Package) -> Wrong:
    """Return the Wrong for a package.xml that is no XML, or not what catkin makes of it."""
    where = f"{package.inside}/package.xml"
    if package.error == TOO_LARGE:
        hint = "take the one of a new package of catkin_create_pkg, which has some sixty lines"
    elif package.malformed:
        line = re.search(r"line (\d+)", package.error)
        where += f":{line[1]}" if line else ""
        hint = "repair that line or the one before: each <tag> needs its </tag>"
    else:
        *words, hint = explained("package.xml", package.error)
        where = place_of(where, read(package.folder / "package.xml"), *words)
    so = "no node of the workspace starts" if package.malformed else "roslaunch starts nothing"
    hint += f". Until then catkin_make fails, and {so}"
    return Wrong("a package.xml that can be read", package.error, where, hint, sure=True)


def first_broken(source: Path, packages: Sequence[Package]) -> Package | None:
    """Return the first package below src whose package.xml is no XML, or None: no node starts then.

    rospy reads every package.xml first, also in a hidden folder, where catkin sees no package.
    """
    broken = broken_manifests(source)
    if not broken:
        return None
    path, complaint = broken[0]
    inside = os.path.relpath(os.path.dirname(path), source)
    hidden = Package(source / inside, inside, error=complaint, malformed=True)
    return next((package for package in packages if package.inside == inside), hidden)


def must_be_launchable(packages: Sequence[Package]) -> None:
    """Raise Wrong for what catkin cannot read; roslaunch asks catkin."""
    for package in packages:
        if package.error:
            raise unreadable(package)
    for package in packages:
        must_be_one([each for each in packages if each.name == package.name])


def must_be_one(packages: Sequence[Package]) -> None:
    """Raise Wrong for several packages of one name."""
    if len(packages) > 1:
        seen = f"{len(packages)}: {', '.join(each.inside for each in packages)}"
        hint = "remove the copy from src, or put an empty file CATKIN_IGNORE into it"
        hint += ": with both of them roslaunch starts nothing"
        expected = f"one package {packages[0].name} in src"
        raise Wrong(expected, seen, packages[1].inside, hint, sure=True)
