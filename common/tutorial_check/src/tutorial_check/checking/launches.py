"""A launch file of the student's: what it would start, and what it starts."""

from __future__ import annotations

import difflib
import os
from pathlib import Path
from typing import Sequence

from tutorial_check.checking.files import File
from tutorial_check.checking.launch_errors import blamed_place, launch_error, package_hint
from tutorial_check.checking.packages import must_be_launchable, package_of
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.checking.texts import text_of_file
from tutorial_check.recording.launch_facts import Node
from tutorial_check.recording.launch_files import read_launch_files
from tutorial_check.submission.launch_xml import Fault, without_comments


class LaunchFile(File):
    """A launch file that roslaunch can read. path: within src; text: without comments."""

    def __init__(
        self, submission: Submission, package: str, path: Path, nodes: Sequence[Node]
    ) -> None:
        """nodes: with package, type, name, namespace, args, remaps, ..."""
        super().__init__(
            submission, package, os.path.relpath(path, submission.package(package).folder)
        )
        self.path, self.nodes = os.path.relpath(path, submission.source), tuple(nodes)
        self.text = without_comments(self.text)


def launch_file(submission: Submission, package: str, name: str) -> LaunchFile:
    """Return a launch file, whose nodes all exist. Raises Wrong."""
    folder = package_of(submission, package).folder
    must_be_launchable(submission)
    paths = {path.name: path for path in sorted(folder.rglob("*launch*"))[::-1] if path.is_file()}
    if name not in paths:
        seen, hint = "no such file in the package", f"write it: launch/{name}"
        for near in difflib.get_close_matches(name, paths, 1, 0.6):
            seen, hint = f"a file {near}", f"call it {name}"
        raise Wrong(f"{package}/launch/{name}", seen, hint=hint)
    facts = submission.recording(
        read_launch_files, os.path.relpath(paths[name], submission.source)
    ).files
    if facts is None:
        hint = "roslaunch --nodes FILE"
        raise Wrong("a launch file that roslaunch can read", "reading it does not end", hint=hint)
    if facts[0]["fault"]:
        fault = Fault(**facts[0]["fault"])
        path, line = blamed_place(fault, submission.is_own)
        text, where = text_of_file(Path(path)), os.path.relpath(path, folder)
        raise launch_error(fault, where, line, text, submission.may_see)
    file = LaunchFile(submission, package, paths[name], facts[0]["nodes"])
    for node in file.nodes:
        seen = f"Cannot locate node of type [{node['type']}] in package [{node['package']}]"
        hint = "look at pkg= and type=: the name of the program's file, which is executable"
        hint = package_hint(node["package"]) if node["found"] is None else hint
        words = f'"{node["type"]}" {node["type"]}'
        file.must(node["found"], words, "nodes that exist", seen, hint)
    return file
