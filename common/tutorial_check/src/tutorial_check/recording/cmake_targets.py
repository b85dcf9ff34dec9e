"""The programs in C++ of a workspace, as CMake's file API reports them (CMake 3.14 and later)."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any, Iterator

from tutorial_check.data.recordings import Executable
from tutorial_check.errors import CannotCheck
from tutorial_check.submission import student_files

API = "build/.cmake/api/v1"
LIBRARIES = ("STATIC_LIBRARY", "SHARED_LIBRARY", "MODULE_LIBRARY", "OBJECT_LIBRARY")
MOST_TARGETS = 2000  # catkin makes some twenty for each package


def ask(workspace: Path) -> None:
    """Ask CMake to report all targets when it configures the workspace."""
    query = workspace / API / "query" / "codemodel-v2"
    query.parent.mkdir(parents=True, exist_ok=True)
    query.touch()


def executables(folder: Path, workspace: Path) -> tuple[Executable, ...]:
    """Return the executables that CMake has configured. folder: above the workspace."""
    targets = {target["id"]: target for target in _targets(folder, workspace)}
    made = []
    for target in targets.values():
        if target.get("type") == "EXECUTABLE" and target.get("artifacts"):
            with contextlib.suppress(LookupError, TypeError, AttributeError):  # it is damaged
                made.append(_executable(target, targets, workspace))
    return tuple(made)


def _targets(folder: Path, workspace: Path) -> Iterator[dict[str, Any]]:
    """Yield what CMake reports of each target; a student's program may have changed it."""
    for path in sorted((workspace / API / "reply").glob("target-*.json"))[:MOST_TARGETS]:
        with contextlib.suppress(CannotCheck, ValueError, RecursionError):
            target = json.loads(student_files.read(folder, path))
            if isinstance(target, dict) and isinstance(target.get("id"), str):
                yield target


def _executable(
    target: dict[str, Any], targets: dict[str, dict[str, Any]], workspace: Path
) -> Executable:
    path = _within(workspace, workspace / "build", target["artifacts"][0]["path"])
    waiting = [target]
    known: set[str] = set()
    sources: dict[str, None] = {}
    while waiting:
        current = waiting.pop(0)
        for source in current.get("sources", []):
            if not source.get("isGenerated"):
                sources[_within(workspace / "src", workspace / "src", source["path"])] = None
        for needed in current.get("dependencies", []):
            other = targets.get(needed["id"])
            if other and other.get("type") in LIBRARIES and needed["id"] not in known:
                known.add(needed["id"])
                waiting.append(other)
    own = tuple(source for source in sources if not source.startswith(("..", "/")))
    return Executable(Path(path).name, path, own, (workspace / path).is_file())


def _within(folder: Path, base: Path, path: str) -> str:
    """Return a path, relative to a base or absolute, as a path within a folder, if it is there."""
    whole = base / path
    return str(whole.relative_to(folder)) if folder in whole.parents else str(whole)
