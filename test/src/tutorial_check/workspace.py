"""The student's workspace: found, unpacked, copied. Needs no ROS but catkin_pkg."""

import contextlib
import os
import re
import shutil
import stat
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from catkin_pkg.package import InvalidPackage, parse_package

from tutorial_check.model import CannotCheck

MOST_BYTES = 300 << 20  # of a workspace's sources; bags included
MOST_FILES = 20_000
# A whole path in a launch file to what a node of the exercises reads.
WHOLE_PATH = re.compile(r"(?<=[\s\"'=])/[^\s\"'<>$]+\.(?:bag|rviz)\b")
LEFT_OUT = {".git", "build", "devel", "install", "__pycache__", ".catkin_tools", "logs"}


@dataclass
class Package:
    """A folder with a package.xml."""

    folder: Path  # in the copy
    inside: str  # its path within the workspace, for the student
    name: str = ""
    error: str = ""  # why catkin cannot read package.xml
    malformed: bool = False  # so that it is no XML at all
    depends: set = field(default_factory=set)  # for building or running
    warnings: list = field(default_factory=list)


@dataclass
class Layout:
    """Where the sources of a workspace are."""

    root: Path  # what the student handed in
    source: Path  # its src folder, or the folder of packages itself
    is_workspace: bool  # there is a src


def unpack(archive, folder):
    """Unpack a zip into a folder. Raises CannotCheck, also for one with a path outside."""
    try:
        with zipfile.ZipFile(archive) as opened:
            members = opened.infolist()
            if (
                sum(member.file_size for member in members) > MOST_BYTES
                or len(members) > MOST_FILES
            ):
                raise CannotCheck(f"{archive}: unpacked it is larger than {MOST_BYTES >> 20} MB")
            for member in members:
                # Of an older PowerShell, whose zips have them against the rule.
                member.filename = member.filename.replace("\\", "/")
                path = Path(member.filename)
                if path.is_absolute() or ".." in path.parts:
                    raise CannotCheck(f"{archive}: has a path outside of itself: {member.filename}")
                if stat.S_ISLNK(member.external_attr >> 16):
                    continue
                target = Path(opened.extract(member, folder))
                mode = (member.external_attr >> 16) & 0o777
                if target.is_file():
                    # One made on Windows knows no rights; then chmod +x cannot be judged.
                    target.chmod((mode or 0o755) | 0o600)
    except (zipfile.BadZipFile, OSError, RuntimeError, NotImplementedError) as error:
        raise CannotCheck(f"{archive}: cannot be unpacked: {error}") from None


def only_zip(folder):
    """The one zip in a folder that has no package, as Moodle hands out what was handed in; or None."""
    zips = [each for each in sorted(Path(folder).iterdir()) if is_zip(each)]
    return zips[0] if len(zips) == 1 and not packages_below(folder) else None


def is_zip(path):
    """Whether it is named like a zip. A link is none: it may lead to what is not the student's."""
    return path.suffix.lower() == ".zip" and path.is_file() and not path.is_symlink()


def find_layout(folder):
    """The Layout of what was handed in: a workspace, its src, a folder of packages, or one."""
    folder = Path(folder)
    if not folder.exists():
        raise CannotCheck(f"{folder}: no such folder")
    if not folder.is_dir():
        raise CannotCheck(f"{folder}: neither a folder nor a zip")
    try:
        for candidate in (folder, *_only_child(folder)):
            if (candidate / "src").is_dir() and not (candidate / "package.xml").exists():
                return Layout(candidate, candidate / "src", True)
            if any(candidate.glob("*/package.xml")):
                return Layout(candidate, candidate, False)
            if (candidate / "package.xml").exists():
                return Layout(candidate.parent, candidate, False)
    except PermissionError as error:
        raise CannotCheck(f"{error.filename}: may not be read") from None
    return Layout(folder, folder / "src", True)


def must_be_ones_own(layout, suite):
    """Raises CannotCheck if a package, or what it is a link to, is one of the suite's solutions."""
    solutions = {
        os.path.realpath(Path(suite, name)) for name in ("beginner_tutorials", "joy2twist")
    }
    inside = []
    with contextlib.suppress(OSError):  # copy() tells of it
        inside = sorted(layout.source.iterdir())
    for each in (layout.source, *inside):
        if os.path.realpath(each) in solutions:
            raise CannotCheck(f"{each} is this suite's solution, not yours: name YOUR workspace")


def _only_child(folder):
    """A zip, or a repository, often has one folder around everything; two at most."""
    for _ in range(2):
        inner = [
            each
            for each in folder.iterdir()
            if each.is_dir() and each.name != "__MACOSX" and not each.name.startswith(".")
        ]
        if len(inner) != 1:
            return
        folder = inner[0]
        yield folder


def copy(layout, target):
    """Copy the sources to target/src. Raises CannotCheck for what cannot be read or is too large."""
    target = Path(target) / "src"
    target.mkdir(parents=True)
    if not layout.source.is_dir():
        return target
    if (layout.source / "package.xml").exists():
        _copy(layout.source, target / layout.source.name, [0, 0, os.path.realpath(target)], set())
    else:
        _copy(layout.source, target, [0, 0, os.path.realpath(target)], set())
    return target


def _copy(source, target, so_far, seen):
    real = os.path.realpath(source)
    if real in seen or real == so_far[2]:
        return  # a link to a folder above, or the copy itself
    target.mkdir(exist_ok=True)
    try:
        entries = sorted(os.scandir(source), key=lambda entry: entry.name)
    except PermissionError:
        raise CannotCheck(f"{source}: may not be read; chmod -R u+rX would help") from None
    for entry in entries:
        if entry.name in LEFT_OUT:
            continue
        try:
            # Of os.path, to which a link to itself is neither; an entry raises OSError.
            if os.path.isdir(entry.path):
                _copy(Path(entry.path), target / entry.name, so_far, seen | {real})
            elif os.path.isfile(entry.path):
                so_far[0] += entry.stat().st_size
                so_far[1] += 1
                if so_far[0] > MOST_BYTES or so_far[1] > MOST_FILES:
                    raise CannotCheck(
                        f"{source}: more than {MOST_BYTES >> 20} MB or {MOST_FILES} files"
                    )
                shutil.copy2(entry.path, target / entry.name)
        except PermissionError:
            raise CannotCheck(f"{entry.path}: may not be read; chmod -R u+rX would help") from None


def named_outside(source):
    """The recordings and RViz views that exist and that launch files name by whole paths."""
    texts = [
        each.read_text(errors="replace") for each in source.rglob("*.launch") if each.is_file()
    ]
    named = {path for text in texts for path in WHOLE_PATH.findall(text)}
    return sorted(each for each in named if os.path.isfile(each))


def packages_below(folder):
    """Every package in a folder, with what is wrong with it, in the order of their paths."""
    found = []
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(
            each for each in folders if each not in LEFT_OUT and not each.startswith(".")
        )
        if "CATKIN_IGNORE" in files:
            folders.clear()
        elif "package.xml" in files:
            found.append(read_package(Path(place), folder))
    return found


def packages_beside(layout):
    """The packages in a workspace beside its src; what lies deeper may be anybody's."""
    beside = sorted(layout.root.iterdir()) if layout.is_workspace else []
    return [
        read_package(each, layout.root)
        for each in beside
        if each != layout.source and os.path.isfile(each / "package.xml")
    ]


def read_package(place, root):
    """The Package in a folder."""
    package = Package(place, os.path.relpath(place, root))
    try:
        parsed = parse_package(str(place), warnings=package.warnings)
        parsed.evaluate_conditions({"ROS_PYTHON_VERSION": "3", "ROS_VERSION": "1"})
    # An AssertionError is catkin's word for a format that is yet to come.
    except (InvalidPackage, AssertionError, OSError, ValueError) as error:
        package.error = " ".join(str(error).split())
        package.name = _name_in(place / "package.xml")
        package.malformed = package.name is None
        package.name = package.name or place.name
        return package
    package.name = parsed.name
    package.depends = {
        each.name
        for each in (*parsed.build_depends, *parsed.exec_depends, *parsed.build_export_depends)
    }
    return package


def _name_in(manifest):
    """The name that a package.xml gives, perhaps none; None if it is no XML."""
    try:
        return ElementTree.parse(manifest).findtext("name", "").strip()
    except (ElementTree.ParseError, OSError, ValueError, LookupError):
        return None


def underlays(devel):
    """(folder for which a devel space was made, CMAKE_PREFIX_PATH it was laid over), or None."""
    try:
        text = (Path(devel) / "_setup_util.py").read_text(errors="replace")
        setup = (Path(devel) / "setup.sh").read_text(errors="replace")
    except OSError:
        return None
    # The first of its assignments, written by catkin: CMAKE_PREFIX_PATH = r'/a;/b'.split(';')
    found = re.search(r"^\s*CMAKE_PREFIX_PATH = r?(['\"])(.*)\1\.split\(", text, re.MULTILINE)
    below = found[2].split(";") if found else []
    made_for = next(
        (
            line.split(":=", 1)[1].rstrip("} \t")
            for line in setup.splitlines()
            if "_CATKIN_SETUP_DIR:=" in line
        ),
        "",
    )
    return made_for, [each for each in below if each]
