"""A launch file of the student's: what it would start, and what it starts."""

from __future__ import annotations

import difflib
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Tuple

from tutorial_check.handout.s5.record import facts_of_files
from tutorial_check.judge.packages import package_of
from tutorial_check.model import Wrong
from tutorial_check.record.session import Session
from tutorial_check.record.stage import Stage
from tutorial_check.source.launch_xml import Fault, Lines, blamed, package_hint, parse_error, read

DIED = re.compile(r"^\[([^\]]+)-\d+\] process has died", re.MULTILINE)


@dataclass(frozen=True)
class LaunchFile(Lines):
    """A launch file that roslaunch can read."""

    path: str  # within src
    where: str  # within its package
    text: str  # without comments
    nodes: Tuple[Dict[str, Any], ...]  # with package, type, name, namespace, args, remaps, ...


def launch_file(session: Session, package: str, name: str) -> LaunchFile:
    """Return a launch file, whose nodes all exist. Raises Wrong."""
    folder = package_of(session, package).folder
    session.must_be_launchable()
    paths = sorted(path for path in folder.rglob("*launch*") if path.is_file())
    path = next((each for each in paths if each.name == name), None)
    if path is None:
        near = difflib.get_close_matches(name, [each.name for each in paths], 1, 0.6)
        seen, hint = "no such file in the package", f"write it: launch/{name}"
        seen, hint = (f"a file {near[0]}", f"call it {name}") if near else (seen, hint)
        raise Wrong(f"{package}/launch/{name}", seen, hint=hint)
    found = session.recording(facts_of_files, os.path.relpath(path, session.source)).files
    if found is None:
        hint = "roslaunch --nodes FILE"
        raise Wrong("a launch file that roslaunch can read", "reading it does not end", hint=hint)
    if found[0]["fault"]:
        fault = Fault(**found[0]["fault"])
        blamed_file, line = blamed(fault, session.is_own)
        where = os.path.relpath(blamed_file, folder)
        text = Path(blamed_file).read_text(errors="replace")
        raise parse_error(fault, where, line, text, session.may_see)
    where, inside = os.path.relpath(path, folder), os.path.relpath(path, session.source)
    file = LaunchFile(inside, where, read(path), tuple(found[0]["nodes"]))
    for node in file.nodes:
        if not node["found"]:
            seen = f"Cannot locate node of type [{node['type']}] in package [{node['package']}]"
            hint = "look at pkg= and type=: the name of the program's file, which is executable"
            hint = package_hint(node["package"]) if node["found"] is None else hint
            raise Wrong("nodes that exist", seen, file.at(f'"{node["type"]}"', node["type"]), hint)
    return file


class Launch:
    """A launch file that runs on a stage."""

    def __init__(self, stage: Stage, path: str, *arguments: str) -> None:
        """Start it. path: within src; arguments: such as x:=1."""
        self._stage = stage
        self.program = stage.launch(["roslaunch", str(stage.session.source / path), *arguments])

    @property
    def nodes(self) -> Tuple[str, ...]:
        """The nodes that the master knows, without the checker's."""
        return tuple(sorted(self._stage.call("state")[0].get("/rosout", [])))

    @property
    def died(self) -> Tuple[str, ...]:
        """Nodes of which roslaunch printed that they have died."""
        return tuple(DIED.findall(self.program.output))

    @property
    def is_over(self) -> bool:
        """Whether it has ended, or a node of it."""
        return self.program.ended or bool(self.died)
