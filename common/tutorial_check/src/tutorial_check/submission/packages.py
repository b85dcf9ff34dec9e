"""The packages of a workspace, as their files say. Needs no ROS but catkin_pkg."""

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

MOST_DEPTH = 100  # Folders in folders: Python calls a function in itself for each.
SOLUTIONS = {"beginner_tutorials", "joy2twist"}  # the packages of the exercises
IGNORED = {"build", "devel", ".git", "__pycache__"}  # folders that no student writes
LEFT_OUT = {*IGNORED, "install", ".catkin_tools", "logs"}  # not sources of a workspace


@dataclass
class Package:
    """A folder with a package.xml."""

    folder: Path  # in the copy
    inside: str  # its path within the workspace, for the student
    name: str = ""
    error: str = ""  # why catkin cannot read package.xml
    malformed: bool = False  # so that it is no XML at all
    format: int = 2
    depends: set[str] = field(default_factory=set)  # for building or running

    @property
    def cmake(self) -> str | None:
        """The text of its CMakeLists.txt without comments, or None. Raises FileTooLarge."""
        path = self.folder / "CMakeLists.txt"
        return re.sub(r"#.*", "", text_of_file(path)) if path.is_file() else None


@dataclass(frozen=True)
class Layout:
    """Where the sources of a workspace are."""

    root: Path = Path()  # what the student handed in
    source: Path = Path()  # its src folder, or the folder of packages itself
    is_workspace: bool = False  # there is a src
    place: str = ""  # root within what was handed in, if another folder


def walk(top: str | Path) -> Iterator[tuple[str, list[str], list[str]]]:
    """Yield what os.walk does, which may be changed as there. Raises CannotCheck."""
    for here, folders, files in os.walk(top):
        if len(Path(here).parts) - len(Path(top).parts) > MOST_DEPTH:
            raise CannotCheck(too_deep(top))
        yield here, folders, files


def too_deep(folder: str | Path) -> str:
    return f"{folder}: folders in folders, more than {MOST_DEPTH} deep"


def packages_below(folder: str | Path) -> list[Package]:
    """Return every package in a folder, with what is wrong with it, in the order of their paths."""
    packages = []
    for here, folders, files in walk(folder):
        folders[:] = sorted(name for name in {*folders} - LEFT_OUT if name[0] != ".")
        if "CATKIN_IGNORE" in files:
            folders.clear()
        elif "package.xml" in files and os.path.isfile(f"{here}/package.xml"):
            packages.append(read_package(Path(here), folder))
    return packages


def packages_beside(layout: Layout) -> list[Package]:
    """Return the packages right beside the src of a workspace; deeper may be another student's."""
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
    # An AssertionError is catkin's word for a format that is yet to come.
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
    """Return (the folder a devel space was made for, or ""; what it was laid over, or None)."""
    files = [Path(devel) / name for name in ("_setup_util.py", "setup.sh")]
    # A pipe would never be read to its end.
    text, setup = (f.read_text(errors="replace") if f.is_file() else "" for f in files)
    # The first of its assignments, written by catkin: CMAKE_PREFIX_PATH = r'/a;/b'.split(';')
    paths = re.search(r"^\s*CMAKE_PREFIX_PATH = r?(['\"])(.*)\1\.split\(", text, re.MULTILINE)
    made_for = re.search(r"_CATKIN_SETUP_DIR:=(.*)", setup)
    below = list(filter(None, paths[2].split(";"))) if paths else None
    return made_for[1].rstrip("} \t") if made_for else "", below
