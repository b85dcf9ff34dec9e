"""What launch files would start, read as roslaunch reads them and nothing started.

In a process of its own, with the student's rights: what a launch file names is read.
"""

from __future__ import annotations

import contextlib
import functools
import io
import json
import shlex
import xml.dom.minidom
from pathlib import Path
from typing import Any, Dict

MARK = "launch facts: "
Node = Dict[str, Any]  # about a node: package, type, name, args ...


@functools.lru_cache(maxsize=None)
def can_be_found(package: str, kind: str) -> bool:
    """Whether rosrun would find such a program."""
    import roslib.packages  # noqa: PLC0415

    try:
        return bool(roslib.packages.find_node(package, kind))
    except roslib.packages.ROSPkgException:
        return False


def device_of(node: Any, params: Any) -> Any:
    """The device that a node is told to read, as joy_node is; or empty."""
    try:
        words = shlex.split(node.args or "")
    except ValueError:  # as a quote without its second; see launch_nodes.words_of
        words = []
    in_args = [word[len("_dev:=") :] for word in words if word.startswith("_dev:=")]
    in_file = params.get(f"{node.namespace}{node.name}/dev")
    return in_args[0] if in_args else str(in_file.value) if in_file else ""


def _node(node: Any, params: Any) -> Node:
    """A dict about one node."""
    return {
        "package": node.package,
        "type": node.type,
        "name": node.name,
        "namespace": node.namespace,
        "args": node.args or "",
        "remaps": [list(each) for each in node.remap_args],
        "respawn": bool(node.respawn),
        "device": device_of(node, params),
        "found": can_be_found(node.package, node.type),
    }


def facts_of(path: str) -> Any:
    """A dict about one launch file."""
    import roslaunch.config  # noqa: PLC0415
    import roslaunch.loader  # noqa: PLC0415

    # What <param command=...> prints is not wanted here, only what would be started.
    value_of = roslaunch.loader.Loader.param_value

    def without_command(self, *about: Any) -> Any:
        *start, value, textfile, binfile, command = about
        value = "" if command is not None else value
        return value_of(self, *start, value, textfile, binfile, None)

    roslaunch.loader.Loader.param_value = without_command
    said = io.StringIO()
    facts = {"path": path, "error": "", "nodes": [], "files": [], "said": ""}
    try:
        document = xml.dom.minidom.parse(path)
        facts["root"] = document.documentElement.tagName
        facts["tags"] = [each.tagName for each in document.getElementsByTagName("*")]
    except Exception as error:
        facts["error"] = f"{error}"
        return facts
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            config = roslaunch.config.load_config_default([path], 11311, verbose=False)
        facts["errors"] = [str(each) for each in config.config_errors]
        facts["nodes"] = [_node(node, config.params) for node in config.nodes]
        facts["files"] = sorted({str(Path(each).resolve()) for each in config.roslaunch_files})
    except (Exception, SystemExit) as error:
        facts["error"] = " ".join(str(error).split())
    facts["said"] = said.getvalue()[-2000:]
    return facts


def tell(paths: Any) -> None:
    """Print one JSON object for each of these launch files."""
    for path in paths:
        print(MARK + json.dumps(facts_of(path)), flush=True)
