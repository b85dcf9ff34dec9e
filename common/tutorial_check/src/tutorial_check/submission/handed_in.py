"""Find, unpack and copy a student's workspace. Of ROS, only catkin_pkg is needed."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import stat
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Iterator

from tutorial_check.errors import CannotCheck
from tutorial_check.submission.packages import (
    IGNORED,
    LEFT_OUT,
    MOST_DEPTH,
    SOLUTIONS,
    Layout,
    packages_below,
    packages_beside,
    too_deep,
    walk,
)
from tutorial_check.submission.student_files import is_too_large

MOST_BYTES = 300 << 20  # of a workspace's sources, including bags
MOST_FILES = 20_000
COPY = "handed_in/src"  # the copy of what was handed in, as in a workspace
# Separators of a launch file's words, and the path in a word of a file that a node reads.
BETWEEN_WORDS, WHOLE_PATH = re.compile(r"[\s\"'<>$]+"), re.compile(r"/.+\.(?:bag|rviz)\b")


def hand_in(given: str | Path, folder: Path) -> tuple[Layout, Path]:
    """Return (Layout, its folder) of a workspace, or of a zip, which is unpacked into a folder.

    A folder with a zip and no workspace, as from Moodle, counts as that zip. Raises CannotCheck.
    """
    given = archive = Path(given)
    if not os.path.isfile(given):
        layout = find_layout(given)
        # A link may lead to another user's file.
        zips = [p for p in given.glob("*.[zZ][iI][pP]") if p.is_file() and not p.is_symlink()]
        if layout.source.is_dir() or len(zips) != 1:
            return layout, given
        archive = zips[0]
    unpack(archive, folder / "unpacked")
    return find_layout(folder / "unpacked"), folder / "unpacked"


def unpack(archive: Path, folder: Path) -> None:
    """Unpack a zip into a folder. Raises CannotCheck, also for a path that leads outside."""
    try:
        with zipfile.ZipFile(archive) as opened:
            members = opened.infolist()
            size = sum(member.file_size for member in members)
            if size > MOST_BYTES or len(members) > MOST_FILES:
                raise CannotCheck(f"{archive}: larger than {MOST_BYTES >> 20} MB when unpacked")
            for member in members:
                # Older versions of PowerShell write backslashes, against the standard.
                member.filename = member.filename.replace("\\", "/")
                path, mode = Path(member.filename), member.external_attr >> 16
                if path.is_absolute() or ".." in path.parts:
                    raise CannotCheck(f"{archive}: a path in it leads outside: {member.filename}")
                target = folder if stat.S_ISLNK(mode) else Path(opened.extract(member, folder))
                if target.is_file():
                    # A zip from Windows has no permissions, so chmod +x cannot be checked.
                    target.chmod((mode & 0o777 or 0o755) | 0o600)
    except CannotCheck:
        raise
    except Exception as error:  # each compression has exceptions of its own
        raise CannotCheck(f"{archive}: cannot be unpacked: {error}") from None


def find_layout(folder: str | Path) -> Layout:
    """Return the Layout of a workspace, its src, a folder of packages, or a package, at any depth.

    If there are several, prefer the exercises' packages. A home folder is not searched.
    """
    folder = Path(folder)
    if not folder.exists():
        hint = "./tutorial shell --in FOLDER makes a workspace"
        raise CannotCheck(f"{folder}: no such folder or zip; {hint}")
    if not folder.is_dir():
        raise CannotCheck(f"{folder}: neither a folder nor a zip")
    home = Path(os.path.expanduser("~")).resolve()
    layouts: dict[Layout, set[str]] = {}  # with their packages
    try:
        os.listdir(folder)
        for here, folders, _ in walk(folder):
            layout = _layout_of(Path(here))
            inside = [*packages_below(layout.source), *packages_beside(layout)] if layout else []
            if layout and (inside or not layouts):
                layouts[layout] = {package.name for package in inside}
            is_end = inside or folder.resolve() in (home, *home.parents)
            folders[:] = [] if is_end else sorted({*folders} - LEFT_OUT)
            folders[:] = [name for name in folders if name[0] != "." and name != "__MACOSX"]
    except PermissionError as error:
        raise CannotCheck(f"{error.filename}: may not be read") from None
    if not layouts:
        return Layout(folder, folder / "src", True)

    def rank(layout: Layout) -> tuple[int, int, Path]:
        return -len(layouts[layout] & SOLUTIONS), len(layout.root.parts), layout.root

    ranked = sorted(filter(layouts.get, layouts), key=rank) or sorted(layouts, key=rank)
    places = [os.path.relpath(layout.root, folder) for layout in ranked[:4]]
    best, place = ranked[0], ", not ".join(places)
    return replace(best, place="" if best.root in (folder, folder.parent) else place)


def _layout_of(folder: Path) -> Layout | None:
    is_package = (folder / "package.xml").exists()
    if (folder / "src").is_dir() and not is_package:
        return Layout(folder, folder / "src", True)
    if any(folder.glob("*/package.xml")):
        return Layout(folder, folder, False)
    return Layout(folder.parent, folder, False) if is_package else None


def must_be_ones_own(layout: Layout, suite: Path) -> None:
    """Raise CannotCheck if a package is, or is a link to, one of the suite's solutions."""
    solutions = {os.path.realpath(suite / name) for name in SOLUTIONS}
    for path in (layout.source, *sorted(layout.source.glob("*"))):
        if os.path.realpath(path) in solutions:
            raise CannotCheck(f"{path} is this suite's solution, not yours: name YOUR workspace")


def copy(layout: Layout, target: Path, inside: str | Path | None = None) -> Path:
    """Copy sources to a folder; return it. Raises CannotCheck if they are unreadable or too large.

    inside: follow only links into this folder; None: follow all links.
    """
    target.mkdir(parents=True)
    source = layout.source
    if source.is_dir():
        copying = _Copying(str(target.resolve()), os.path.realpath(inside) if inside else None)
        is_package = (source / "package.xml").exists()
        copying.copy(source, target / source.name if is_package else target, frozenset())
    # catkin's link, which git without links, zip and Windows turn into a file.
    toplevel = target / "CMakeLists.txt"
    if toplevel.is_file() and b"toplevel" in toplevel.read_bytes():
        toplevel.unlink()
    return target


@dataclass
class _Copying:
    """Copies files that may change meanwhile: each is held, then examined, then opened."""

    target: str
    inside: str | None
    size: int = 0
    count: int = 0

    def copy(self, source: Path, target: Path, seen: frozenset[str]) -> None:
        """Copy a file, or a folder's content; skip special files, and what is outside."""
        with contextlib.ExitStack() as stack:
            try:
                held = os.open(source, os.O_PATH | os.O_CLOEXEC)
                stack.callback(os.close, held)
                about, real = os.fstat(held), os.readlink(f"/proc/self/fd/{held}")
                is_folder = stat.S_ISDIR(about.st_mode)
                if self.inside and not f"{real}/".startswith(f"{self.inside}/"):
                    return
                if not is_folder and not stat.S_ISREG(about.st_mode):
                    return
                opened = os.open(f"/proc/self/fd/{held}", os.O_RDONLY | os.O_CLOEXEC)
                stack.callback(os.close, opened)
            except PermissionError:
                raise CannotCheck(f"{source}: may not be read; chmod -R u+rX would help") from None
            except OSError:  # a link to nowhere, or to itself
                return
            if not is_folder:
                self._copy_file(opened, about, source, target)
            elif len(seen) > MOST_DEPTH:
                raise CannotCheck(too_deep(source.parents[MOST_DEPTH]))
            elif real not in seen and real != self.target:  # no link to a folder above
                target.mkdir(exist_ok=True)
                for name in sorted(set(os.listdir(opened)) - LEFT_OUT):
                    self.copy(source / name, target / name, seen | {real})

    def _copy_file(self, opened: int, about: os.stat_result, source: Path, target: Path) -> None:
        self.size += about.st_size
        self.count += 1
        if self.size > MOST_BYTES or self.count > MOST_FILES:
            most = f"{MOST_BYTES >> 20} MB or {MOST_FILES} files"
            raise CannotCheck(f"{source.parent}: more than {most}")
        with open(opened, "rb", closefd=False) as file, target.open("wb") as copied:
            shutil.copyfileobj(file, copied)
        target.chmod((about.st_mode & 0o777) | 0o400)
        os.utime(target, ns=(about.st_atime_ns, about.st_mtime_ns))


def named_outside(source: Path) -> list[str]:
    """Return existing bags and RViz configurations that launch files name by absolute paths."""
    files = [path for path in source.rglob("*.launch") if path.is_file()]
    texts = [path.read_text(errors="replace") for path in files if not is_too_large(path)]
    words = {word for text in texts for word in BETWEEN_WORDS.split(text)}
    # A path, alone or in a parameter such as _file:=/a/path.
    named = (WHOLE_PATH.match(w, 0 if w[:1] == "/" else w.find("=/") + 1) for w in words)
    return sorted({path[0] for path in named if path and os.path.isfile(path[0])})


def all_below(folder: str | Path) -> Iterator[str]:
    """Yield the paths of everything in a folder, in order, except IGNORED folders."""
    for here, folders, files in walk(folder):
        folders[:] = sorted(set(folders) - IGNORED)
        # A folder may be a link.
        yield from (os.path.join(here, name) for name in sorted((*files, *folders)))
