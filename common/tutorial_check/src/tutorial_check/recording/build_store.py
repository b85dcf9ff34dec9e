"""Where builds are kept between the checks of a workspace.

A worker reads the last build from a descriptor, and writes its own to another. Outside the sandbox
nothing looks into a build: it is only named, replaced and removed.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import tempfile
from pathlib import Path

from tutorial_check.recording.build_tree import MOST_BYTES, WHOLE
from tutorial_check.submission.order import Order

MOST_KEPT_BYTES = 500 << 20  # of all builds
SYSTEM = ("/var/lib/dpkg/status", "/usr/bin/c++", "/usr/bin/cmake")  # change with compiler, ROS


def cache() -> Path:
    """Return the folder of the builds."""
    caches = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache")
    return caches.expanduser() / "ros1_tutorial" / "builds"


class BuildStore:
    """The last build of a workspace, and a place for the next. Without a cache there is none."""

    def __init__(self, order: Order) -> None:
        self._file = cache() / name_of_build(order)
        self._ends = contextlib.ExitStack()
        self._unkept = ""
        self.last: int | None = None  # a descriptor
        self.new: int | None = None

    def __enter__(self) -> BuildStore:
        with contextlib.suppress(OSError):
            self._file.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            self.new, self._unkept = tempfile.mkstemp(prefix=".", dir=self._file.parent)
            self._ends.callback(os.close, self.new)
            self.last = os.open(self._file, os.O_RDONLY)
            self._ends.callback(os.close, self.last)
            os.utime(self.last)  # used: trim() removes it later
        return self

    @property
    def descriptors(self) -> list[int]:
        """The worker's arguments."""
        return [number for number in (self.new, self.last) if number is not None]

    def __exit__(self, *_: object) -> None:
        self.keep()
        self._ends.close()
        with contextlib.suppress(OSError):
            os.unlink(self._unkept)

    def keep(self) -> None:
        """Keep the new build, if it is complete, for the next worker."""
        with contextlib.suppress(OSError):
            with open(self._unkept, "rb") as file:
                size = os.fstat(file.fileno()).st_size
                file.seek(max(0, size - len(WHOLE)))
                is_whole = file.read() == WHOLE and size < 2 * MOST_BYTES
            if is_whole:
                os.replace(self._unkept, self._file)
                trim(self._file.parent)


def trim(folder: Path, most_bytes: int = MOST_KEPT_BYTES) -> None:
    """Remove the builds that were not used for longest, if all are too large. Raises OSError."""
    newest_first = sorted(folder.iterdir(), key=lambda path: -path.stat().st_mtime)
    for path in newest_first:
        most_bytes -= path.stat().st_size
        if most_bytes < 0:
            path.unlink()


def name_of_build(order: Order) -> str:
    """Return a name for builds of a workspace, which also what a build depends on changes."""
    facts: list[object] = [os.path.realpath(order.workspace), str(order.folder.parent)]
    facts += [
        order.underlay,
        order.sandbox.environment,
        order.variant,
        _code(),
        _stamps(order.underlay),
    ]
    return hashlib.sha256(json.dumps(facts, default=str).encode()).hexdigest()[:32]


def _stamps(underlay: str) -> list[tuple[str, int, int]]:
    """Return (path, time, size) of what comes with compiler, CMake, ROS and the underlay."""
    devel = Path(underlay).parent
    below = (*devel.glob("include/**/*"), *devel.glob("share/**/*.cmake"))
    files = filter(os.path.exists, [*SYSTEM, *map(str, sorted(below))])
    stats = ((path, os.stat(path)) for path in files)
    return [(path, about.st_mtime_ns, about.st_size) for path, about in stats]


@functools.lru_cache(maxsize=None)
def _code() -> str:
    """Return a digest of the checker, which another version may build otherwise."""
    files = sorted(Path(__file__).parents[1].rglob("*.py"))
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in files)).hexdigest()
