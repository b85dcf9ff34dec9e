"""What launch files would start, read as roslaunch reads them and nothing started.

A separate program with the student's rights, as it reads what a launch file names. Its arguments are
launch files; it prints a line for each, MARK and a JSON object.
"""

from __future__ import annotations

import contextlib
import functools
import io
import json
import shlex
import sys
import xml.dom.minidom
from pathlib import Path
from typing import Any, Dict

MARK = "launch facts: "
Node = Dict[str, Any]  # about a node: package, type, name, args ...


@functools.lru_cache(maxsize=None)
def can_be_found(package: str, kind: str) -> bool:
    import roslib.packages  # noqa: PLC0415

    try:
        return bool(roslib.packages.find_node(package, kind))
    except roslib.packages.ROSPkgException:
        return False


def device_of(node: Any, params: Any) -> str:
    """Return the device that a node is made to read, as joy_node is; or empty."""
    try:
        words = shlex.split(node.args or "")
    except ValueError:  # as a quote without its second; see launch_nodes.words_of
        words = []
    in_args = [word[len("_dev:=") :] for word in words if word.startswith("_dev:=")]
    in_file = params.get(f"{node.namespace}{node.name}/dev")
    return in_args[0] if in_args else str(in_file.value) if in_file else ""


def _node(node: Any, params: Any) -> Node:
    plain = ("package", "type", "name", "namespace")
    return {
        **{name: getattr(node, name) for name in plain},
        "args": node.args or "",
        "remaps": [list(each) for each in node.remap_args],
        "respawn": bool(node.respawn),
        "device": device_of(node, params),
        "found": can_be_found(node.package, node.type),
    }


def facts_of(path: str) -> dict[str, Any]:
    """Return what a launch file says; with an error, as far as roslaunch reads it."""
    import roslaunch.config  # noqa: PLC0415
    import roslaunch.loader  # noqa: PLC0415

    value_of = roslaunch.loader.Loader.param_value

    def without_command(self: Any, *about: Any) -> Any:
        """Do without what <param command=...> prints: wanted is only what would be started."""
        *start, value, textfile, binfile, command = about
        return value_of(self, *start, value if command is None else "", textfile, binfile, None)

    roslaunch.loader.Loader.param_value = without_command
    said = io.StringIO()
    facts: dict[str, Any] = {"path": path, "error": "", "nodes": [], "files": [], "said": ""}
    try:
        document = xml.dom.minidom.parse(path)
        facts["root"] = getattr(document.documentElement, "tagName", "")
        facts["tags"] = [each.tagName for each in document.getElementsByTagName("*")]
    except Exception as error:
        return {**facts, "error": str(error)}
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            config = roslaunch.config.load_config_default([path], 11311, verbose=False)
        facts["errors"] = [str(each) for each in config.config_errors]
        facts["nodes"] = [_node(node, config.params) for node in config.nodes]
        facts["files"] = sorted({str(Path(each).resolve()) for each in config.roslaunch_files})
    except (Exception, SystemExit) as error:
        facts["error"] = " ".join(str(error).split())
    return {**facts, "said": said.getvalue()[-2000:]}


if __name__ == "__main__":
    sys.path.pop(0)  # this folder, where roslaunch needs nothing
    for each in sys.argv[1:]:
        print(MARK + json.dumps(facts_of(each)), flush=True)
