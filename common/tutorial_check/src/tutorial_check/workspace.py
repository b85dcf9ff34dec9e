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
from tutorial_check.place import own_rights

MOST_BYTES = 300 << 20  # of a workspace's sources; bags included
MOST_FILES = 20_000
COPY = "handed_in"  # folder of the copy of what was handed in
# The words of a launch file, and in one of them what a node of the exercises reads.
BETWEEN_WORDS, WHOLE_PATH = re.compile(r"[\s\"'<>$]+"), re.compile(r"/.+\.(?:bag|rviz)\b")
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


def hand_in(given, folder):
    """(Layout, the folder that it lies in) of a workspace, or of a zip, which is unpacked in a folder.

    A folder with nothing but a zip is that zip. Raises CannotCheck.
    """
    given = archive = Path(given)
    if not given.is_file():
        layout = find_layout(given)
        archive = None if layout.source.is_dir() else only_zip(given)
        if not archive:
            return layout, given
    unpack(archive, folder / "unpacked")
    return find_layout(folder / "unpacked"), folder / "unpacked"


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
    except CannotCheck:
        raise
    except Exception as error:  # each way to pack has errors of its own for bytes that are none
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


def copy(layout, target, inside=None):
    """Copy the sources to a folder, which is returned. Raises CannotCheck for what cannot be read or is too large.

    inside: of links only those are followed that lead to something in this folder; None: all.
    """
    target = Path(target)
    inside = inside and os.path.realpath(inside)
    so_far = [0, 0, os.path.realpath(target)]
    target.mkdir(parents=True)
    if (layout.source / "package.xml").exists():
        _copy(layout.source, target / layout.source.name, so_far, inside, set())
    elif layout.source.is_dir():
        _copy(layout.source, target, so_far, inside, set())
    return target


def _open(path, inside):
    """The descriptor of a file or folder; None if it is something else, or lies outside.

    What lies at the path may change meanwhile: so it is first held, then looked at, then opened.
    """
    try:
        held = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except PermissionError:
        raise
    except OSError:  # a link to nowhere, or to itself
        return None
    try:
        mode = os.fstat(held).st_mode
        is_inside = inside is None or f"{_path_of(held)}/".startswith(f"{inside}/")
        if not is_inside or not (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
            return None
        return os.open(f"/proc/self/fd/{held}", os.O_RDONLY | os.O_CLOEXEC)
    finally:
        os.close(held)


def _path_of(descriptor):
    return os.readlink(f"/proc/self/fd/{descriptor}")


def _copy(source, target, so_far, inside, seen):
    try:
        descriptor = _open(source, inside)
    except PermissionError:
        raise CannotCheck(f"{source}: may not be read; chmod -R u+rX would help") from None
    if descriptor is None:
        return
    try:
        about = os.fstat(descriptor)
        if stat.S_ISDIR(about.st_mode):
            real = _path_of(descriptor)
            if real in seen or real == so_far[2]:
                return  # a link to a folder above, or the copy itself
            target.mkdir(exist_ok=True)
            for name in sorted(set(os.listdir(descriptor)) - LEFT_OUT):
                _copy(source / name, target / name, so_far, inside, seen | {real})
            return
        so_far[0] += about.st_size
        so_far[1] += 1
        if so_far[0] > MOST_BYTES or so_far[1] > MOST_FILES:
            raise CannotCheck(
                f"{source.parent}: more than {MOST_BYTES >> 20} MB or {MOST_FILES} files"
            )
        with open(descriptor, "rb", closefd=False) as file, target.open("wb") as copied:
            shutil.copyfileobj(file, copied)
        target.chmod((about.st_mode & 0o777) | 0o400)
        os.utime(target, ns=(about.st_atime_ns, about.st_mtime_ns))
    finally:
        os.close(descriptor)


def named_outside(source):
    """The recordings and RViz views that exist and that launch files name by whole paths."""
    texts = [
        each.read_text(errors="replace") for each in source.rglob("*.launch") if each.is_file()
    ]
    words = {word for text in texts for word in BETWEEN_WORDS.split(text)}
    named = {
        WHOLE_PATH.match(word, 0 if word[:1] == "/" else word.find("=/") + 1) for word in words
    }
    return sorted(each[0] for each in named if each and os.path.isfile(each[0]))


def packages_below(folder):
    """Every package in a folder, with what is wrong with it, in the order of their paths."""
    found = []
    for here, folders, files in os.walk(folder):
        folders[:] = sorted(
            each for each in folders if each not in LEFT_OUT and not each.startswith(".")
        )
        if "CATKIN_IGNORE" in files:
            folders.clear()
        elif "package.xml" in files and os.path.isfile(f"{here}/package.xml"):
            found.append(read_package(Path(here), folder))
    return found


@own_rights()
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


@own_rights()
def underlays(devel):
    """(folder for which a devel space was made, CMAKE_PREFIX_PATH it was laid over), or None."""
    files = [Path(devel) / name for name in ("_setup_util.py", "setup.sh")]
    if not all(each.is_file() for each in files):  # a pipe would never be read to its end
        return None
    text, setup = (each.read_text(errors="replace") for each in files)
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
