"""The files of a build, as a worker hands them to the workers of the next checks.

A build tree has the absolute path of the worker's folder in many files, text and binary. Names of
such folders have the same length, so the new name replaces the old one, and no file changes its
size. The next build is decided by contents, not by times: an unchanged source gets an old time, a
changed one the current time. A tree is continued only if nothing but the content of C++
sources and scripts differs. After any other change catkin_make begins again: what a removed target,
header, message or variable of CMake left behind would otherwise make a wrong workspace right.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import stat
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterator, Optional, Tuple

from tutorial_check.data.json_data import as_json, from_json
from tutorial_check.data.recordings import Built

TREES = ("build", "devel")  # in ws
MOST_BYTES = 64 << 20  # a talker and a listener have 2 MB
WHOLE = b"\nwhole\n"  # ends a build that was written completely
CODE = {".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx"}
SCRIPTS = {".bag", ".launch", ".md", ".py", ".rviz"}  # no build reads them, except setup.py
LINKED = (b"\x7fELF", b"!<arch>")  # begin programs and libraries
LONG_AGO_S = 1_000_000_000  # older than what any build makes


@dataclass(frozen=True)
class Kept:
    """What catkin_make has made of a workspace."""

    folder: str  # the worker's
    sources: Dict[str, str]  # see digests_of()
    whole: Built
    part: Optional[Built]  # the exercises' packages, if all of them cannot be built
    files: Tuple[Tuple[str, int, int, int], ...]  # path in ws, mode, time [ns], size


def digests_of(source: Path) -> Dict[str, str]:
    """Return {path in src: digest} of the files and folders of a workspace."""
    digests = {}
    for here, folders, files in os.walk(source):
        for name in (*folders, *files):
            path = Path(here, name)
            about = path.lstat()
            content = _digest(path) if stat.S_ISREG(about.st_mode) else ""
            digests[str(path.relative_to(source))] = f"{about.st_mode:o} {content}"
    return digests


def _digest(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        for block in iter(lambda: file.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()


def changed(before: Dict[str, str], now: Dict[str, str]) -> set[str]:
    """Return the paths that were added, removed or changed."""
    return {path for path in {*before, *now} if before.get(path) != now.get(path)}


def may_continue(before: Dict[str, str], now: Dict[str, str]) -> bool:
    """Return whether CMake and make notice all that has changed."""
    for path in map(Path, changed(before, now)):
        is_there = str(path) in before and str(path) in now
        is_script = path.suffix in SCRIPTS and path.name != "setup.py"
        if not is_script and not (is_there and path.suffix in CODE):
            return False
    return True


def needs_cmake(kept: Kept, now: Dict[str, str]) -> bool:
    """Return whether a build that continues begins with CMake, which make does not start by itself
    after it has failed, or if it read another file.
    """
    suffixes = {Path(path).suffix for path in changed(kept.sources, now)}
    return kept.whole.code != 0 or not suffixes <= CODE


def is_elsewhere_as_before(workspace: Path, sources: Dict[str, str]) -> bool:
    """Return whether a build has made files only in its own folders, which alone are kept."""
    is_own = {*os.listdir(workspace)} <= {"src", *TREES, ".catkin_workspace"}
    return is_own and changed(sources, digests_of(workspace / "src")) <= {"CMakeLists.txt"}


def write(descriptor: int, kept: Kept, workspace: Path) -> None:
    """Write a build, but for `files`, to a descriptor; close it.

    Write nothing if the build has links, special files, or is too large.
    """
    with open(descriptor, "wb") as file, contextlib.suppress(ValueError):
        contents = list(_contents(workspace))
        header = {**vars(kept), "files": [about for about, _ in contents]}
        file.write(json.dumps(as_json(header)).encode() + b"\n")
        file.writelines(content for _, content in contents)
        file.write(WHOLE)


def _contents(workspace: Path) -> Iterator[Tuple[Tuple[str, int, int, int], bytes]]:
    """Yield a file's entry in Kept.files, and its content. Raises ValueError."""
    left = MOST_BYTES
    for tree in TREES:
        for here, folders, files in os.walk(workspace / tree):
            for path in (Path(here), *(Path(here, name) for name in (*folders, *files))):
                about = path.lstat()
                if stat.S_ISDIR(about.st_mode):
                    continue
                left -= about.st_size
                if left < 0 or not stat.S_ISREG(about.st_mode):
                    raise ValueError(path)
                inside, content = str(path.relative_to(workspace)), path.read_bytes()
                mode = stat.S_IMODE(about.st_mode)
                yield (inside, mode, about.st_mtime_ns, len(content)), content


def restored(descriptor: int, folder: Path, sources: Dict[str, str]) -> Kept | None:
    """Restore a build in a worker's folder; close the descriptor. Return None if there is none.

    It must run before any program of the student, which could plant links.
    """
    with open(descriptor, "rb") as file:
        data = file.read(2 * MOST_BYTES)
    try:
        kept = from_json(Kept, json.loads(data.partition(b"\n")[0]))
        old, new = Path(kept.folder).name.encode(), folder.name.encode()
        data = data.replace(old, new)
        header, _, content = data.partition(b"\n")
        kept = from_json(Kept, json.loads(header))
    except (ValueError, RecursionError):
        return None
    # A clock that was set back would hide changes from make.
    newest_ns = max((time_ns for _, _, time_ns, _ in kept.files), default=0)
    if len(old) != len(new) or not data.endswith(WHOLE) or newest_ns > time.time_ns():
        return None
    is_same = kept.sources == sources
    if not is_same and (kept.part or not may_continue(kept.sources, sources)):
        return None
    _write_files(kept, content, folder / "ws", is_same)
    _set_times(folder / "ws" / "src", changed(kept.sources, sources))
    return kept


def _write_files(kept: Kept, content: bytes, workspace: Path, is_same: bool) -> None:
    """Write the files. If the build continues, programs and libraries must be linked again: of a
    build that fails nothing older may be left.
    """
    start = 0
    for inside, mode, time_ns, size in kept.files:
        path, part = workspace / inside, content[start : start + size]
        start += size
        path.parent.mkdir(parents=True, exist_ok=True)
        if is_same or path.suffix == ".o" or not part.startswith(LINKED):
            path.write_bytes(part)
            path.chmod(mode)
            os.utime(path, ns=(time_ns, time_ns))


def _set_times(source: Path, new: set[str]) -> None:
    """Let make find all sources old, except new ones."""
    now_s = time.time()
    for here, _, files in os.walk(source):
        for path in (Path(here, name) for name in files):
            time_s = now_s if str(path.relative_to(source)) in new else LONG_AGO_S
            os.utime(path, (time_s, time_s), follow_symlinks=False)
