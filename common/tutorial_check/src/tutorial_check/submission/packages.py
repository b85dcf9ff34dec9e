"""The packages of a workspace, from their files. Of ROS, only catkin_pkg is needed."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterator
from xml.etree import ElementTree

from catkin_pkg.package import InvalidPackage, parse_package

from tutorial_check.errors import CannotCheck
from tutorial_check.submission.student_files import TOO_LARGE, is_too_large, text_of_file

MOST_DEPTH = 100  # of nested folders, because Python's recursion is limited
SOLUTIONS = {"beginner_tutorials", "joy2twist"}  # the packages of the exercises
IGNORED = {"build", "devel", ".git", "__pycache__"}  # folders that tools write
LEFT_OUT = {*IGNORED, "install", ".catkin_tools", "logs"}  # no sources


@dataclass
class Package:
    """A folder with a package.xml."""

    folder: Path  # in the copy
    inside: str  # its path within the workspace, for the student
    name: str = ""
    error: str = ""  # why catkin cannot read package.xml
    malformed: bool = False  # package.xml is no XML
    format: int = 2
    depends: set[str] = field(default_factory=set)  # build and exec dependencies

    @property
    def cmake(self) -> str | None:
        """The text of its CMakeLists.txt without comments, or None. Raises FileTooLarge."""
        path = self.folder / "CMakeLists.txt"
        return re.sub(r"#.*", "", text_of_file(path)) if path.is_file() else None


@dataclass(frozen=True)
class Layout:
    """Where the sources of a workspace are."""

    root: Path = Path()  # of the submission
    source: Path = Path()  # its src folder, or the folder of packages itself
    is_workspace: bool = False  # has a src
    place: str = ""  # root within the submission, if another folder


def walk(top: str | Path) -> Iterator[tuple[str, list[str], list[str]]]:
    """Yield from os.walk, whose lists may be changed. Raises CannotCheck for too deep folders."""
    for here, folders, files in os.walk(top):
        if len(Path(here).parts) - len(Path(top).parts) > MOST_DEPTH:
            raise CannotCheck(too_deep(top))
        yield here, folders, files


def too_deep(folder: str | Path) -> str:
    return f"{folder}: folders in folders, more than {MOST_DEPTH} deep"


def packages_below(folder: str | Path) -> list[Package]:
    """Return all packages in a folder, with their errors, in the order of their paths."""
    packages = []
    for here, folders, files in walk(folder):
        folders[:] = sorted(name for name in {*folders} - LEFT_OUT if name[0] != ".")
        if "CATKIN_IGNORE" in files:
            folders.clear()
        elif "package.xml" in files and os.path.isfile(f"{here}/package.xml"):
            packages.append(read_package(Path(here), folder))
    return packages


def packages_beside(layout: Layout) -> list[Package]:
    """Return the packages directly beside src; deeper ones may be another student's."""
    manifests = sorted(layout.root.glob("*/package.xml")) if layout.is_workspace else []
    beside = (manifest.parent for manifest in manifests if manifest.is_file())
    return [read_package(path, layout.root) for path in beside if path != layout.source]


def read_package(place: Path, root: str | Path) -> Package:
    package = Package(place, os.path.relpath(place, root))
    if is_too_large(place / "package.xml"):
        package.name, package.error, package.malformed = place.name, TOO_LARGE, True
        return package
    try:
        parsed = parse_package(str(place), warnings=[])
        parsed.evaluate_conditions({"ROS_PYTHON_VERSION": "3", "ROS_VERSION": "1"})
    # catkin_pkg raises AssertionError for a future format.
    except (InvalidPackage, AssertionError, OSError, ValueError) as error:
        package.error = " ".join(str(error).split())
        try:
            name = ElementTree.parse(place / "package.xml").findtext("name") or ""
        except (ElementTree.ParseError, OSError, ValueError, LookupError):
            name, package.malformed = "", True
        package.name = name.strip() or place.name
        return package
    package.name, package.format = parsed.name, parsed.package_format
    depends = (*parsed.build_depends, *parsed.exec_depends, *parsed.build_export_depends)
    package.depends = {dependency.name for dependency in depends}
    return package


def underlays(devel: str | Path) -> tuple[str, list[str] | None]:
    """Return (the folder of a devel space when it was made, or ""; its underlays, or None)."""
    files = [Path(devel) / name for name in ("_setup_util.py", "setup.sh")]
    # Reading a pipe would never end.
    text, setup = (f.read_text(errors="replace") if f.is_file() else "" for f in files)
    # catkin's first assignment: CMAKE_PREFIX_PATH = r'/a;/b'.split(';')
    paths = re.search(r"^\s*CMAKE_PREFIX_PATH = r?(['\"])(.*)\1\.split\(", text, re.MULTILINE)
    made_for = re.search(r"_CATKIN_SETUP_DIR:=(.*)", setup)
    below = list(filter(None, paths[2].split(";"))) if paths else None
    return made_for[1].rstrip("} \t") if made_for else "", below
