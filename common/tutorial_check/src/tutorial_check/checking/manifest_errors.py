"""Errors in any package.xml of the workspace, which stop the other packages, too."""

from __future__ import annotations

import re
from typing import Sequence

from tutorial_check.checking.causes import explained
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.texts import read_xml
from tutorial_check.submission.launch_xml import place_of
from tutorial_check.submission.packages import Package
from tutorial_check.submission.student_files import TOO_LARGE


def unreadable(package: Package) -> Wrong:
    """Return the Wrong for a package.xml that is no XML, or that catkin refuses."""
    where = f"{package.inside}/package.xml"
    if package.error == TOO_LARGE:
        hint = "copy the one that catkin_create_pkg makes: it has about sixty lines"
    elif package.malformed:
        line = re.search(r"line (\d+)", package.error)
        where += f":{line[1]}" if line else ""
        hint = "repair that line or the one before: each <tag> needs its </tag>"
    else:
        *words, hint = explained("package.xml", package.error)
        where = place_of(where, read_xml(package.folder / "package.xml"), *words)
    so = "no node of the workspace starts" if package.malformed else "roslaunch starts nothing"
    hint += f". Until then catkin_make fails, and {so}"
    return Wrong("a package.xml that can be read", package.error, where, hint, sure=True)


def must_be_unique(packages: Sequence[Package]) -> None:
    """Raise Wrong for several packages of one name."""
    if len(packages) > 1:
        seen = f"{len(packages)}: {', '.join(package.inside for package in packages)}"
        hint = "remove the copy from src, or put an empty file CATKIN_IGNORE into it"
        hint += ": with both of them roslaunch starts nothing"
        expected = f"one package {packages[0].name} in src"
        raise Wrong(expected, seen, packages[1].inside, hint, sure=True)
