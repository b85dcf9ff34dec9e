"""A student's launch file, and what roslaunch would start."""

from __future__ import annotations

import difflib
import os
from pathlib import Path
from typing import Any, Iterable

from tutorial_check.checking.launch_errors import UNSET, blamed_place, launch_error, package_hint
from tutorial_check.checking.package_files import File
from tutorial_check.checking.packages import must_be_launchable, package_of
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.checking.texts import read_xml, text_of_file
from tutorial_check.data.recorders import LAUNCH_FILES
from tutorial_check.data.recordings import LaunchNode
from tutorial_check.submission.launch_xml import Fault, attribute, place_of
from tutorial_check.submission.manifests import is_stand_in


class LaunchFile(File):
    """A launch file, and what roslaunch makes of it. path: within src; text: without comments."""

    def __init__(
        self, submission: Submission, package: str, path: Path, others: Iterable[Path] = ()
    ) -> None:
        """Read it, together with others that later checks need. Raises Wrong."""
        folder, source = submission.package(package).folder, submission.source
        super().__init__(submission, package, os.path.relpath(path, folder))
        self.path, self.text = os.path.relpath(path, source), read_xml(path)
        must_be_launchable(submission)
        paths = {os.path.relpath(other, source): other for other in (*others, path)}
        files = submission.recording(LAUNCH_FILES, *paths).files
        if files is None:
            expected, hint = "launch files that roslaunch can read", "roslaunch --nodes FILE"
            raise Wrong(expected, "reading them does not end", hint=hint)
        names = [Path(facts["path"]).name for facts in files]
        self.facts: dict[str, Any] = files[names.index(path.name)]
        # The nodes that it starts: package, type, name, namespace, args, remaps, ...
        self.nodes: list[LaunchNode] = self.facts["nodes"]

    def must_be_read(self) -> None:
        """Raise Wrong if roslaunch cannot read this file or one that it includes."""
        if not self.facts["fault"]:
            return
        fault, submission = Fault(**self.facts["fault"]), self.submission
        place, line = blamed_place(fault, submission.is_own)
        path = Path(place)
        text = text_of_file(path)
        wrong = launch_error(fault, self.inside(path), line, text, submission.may_see)
        inner, number = fault.places[-1]
        if not submission.is_own(inner) and fault.kind != UNSET:
            wrong.seen += f" (in {inner}:{number})"
        hiding = (package for package in submission.packages if package.folder in path.parents)
        for name in (package.name for package in hiding if is_stand_in(package.name)):
            wrong.hint += f"; or remove {name} from src: this suite has one that needs nothing else"
        raise wrong

    def inside(self, path: Path) -> str:
        """Return a file's path relative to the student's package, or else to src."""
        inside = os.path.relpath(path, self.submission.package(self.package).folder)
        return os.path.relpath(path, self.submission.source) if inside[:2] == ".." else inside

    def at_node(self, node: LaunchNode) -> str:
        """Return FILE:LINE of a node, which may be in an included file."""
        path = Path(node["filename"])
        path = path if self.submission.is_own(path) else self.submission.source / self.path
        words = (*attribute("type", node["type"]), Path(node["type"]).name)
        return place_of(self.inside(path), read_xml(path), *words)

    def missing(self, node: LaunchNode) -> Wrong:
        """Return the Wrong for a node whose program or package does not exist."""
        hint = "look at pkg= and type=: rosrun PACKAGE, then Tab twice, lists its programs"
        hint = package_hint(node["package"]) if node["found"] is None else hint
        seen = f"Cannot locate node of type [{node['type']}] in package [{node['package']}]"
        return Wrong("nodes that exist", seen, self.at_node(node), hint)


def find_launch(submission: Submission, package: str, name: str, hint: str = "") -> Path:
    """Return the path of a launch file. Raises Wrong. hint: what to do if it is missing."""
    folder, own = package_of(submission, package).folder, submission.task.name_of(package)
    paths = sorted(path for path in folder.rglob(name) if path.is_file())
    if len(paths) > 1:
        inside = [str(path.relative_to(folder)) for path in paths]
        hint = f"roslaunch says 'multiple files named {name}' and starts nothing: keep one in"
        seen = f"several: {', '.join(inside)}"
        raise Wrong(f"one file {name}", seen, inside[1], f"{hint} {own}/launch")
    if paths:
        return paths[0]
    files = (path for path in submission.source.rglob("*launch*") if path.is_file())
    others = {path.name.lower(): path for path in sorted(files) if path.name != name}
    expected = f"{submission.task.in_messages(package)}/launch/{name}"
    for near in difflib.get_close_matches(name.lower(), others, 1, 0.85):
        other = os.path.relpath(others[near], submission.source)
        hint = f"its name must be {name}, and its place {own}/launch"
        raise Wrong(expected, f"a file {other}", other, hint)
    hint = hint or f"write it: launch/{name}"
    raise Wrong(expected, "no such file in your package", f"{package}/launch", hint)


def launch_file(submission: Submission, package: str, name: str) -> LaunchFile:
    """Return a launch file, whose nodes all exist. Raises Wrong."""
    file = LaunchFile(submission, package, find_launch(submission, package, name))
    file.must_be_read()
    for node in file.nodes:
        if not node["found"]:
            raise file.missing(node)
    return file
