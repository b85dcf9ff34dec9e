"""Print what launch files would start, read as roslaunch reads them; start nothing.

This is a separate program with the student's rights, because it reads what launch files name. For
each launch file in its arguments it prints a line: MARK and a JSON object.
"""

from __future__ import annotations

import contextlib
import functools
import io
import json
import shlex
import sys
import traceback
from pathlib import Path
from typing import Any
from xml.dom.minidom import Element
from xml.parsers import expat

MARK = "launch facts: "


@functools.lru_cache(maxsize=None)
def can_be_found(package: str, kind: str) -> bool | None:
    """Return whether a program exists; None if its package does not exist, either."""
    import roslib.packages  # noqa: PLC0415
    import rospkg  # noqa: PLC0415

    try:
        return bool(roslib.packages.find_node(package, kind))
    except (roslib.packages.ROSPkgException, rospkg.ResourceNotFound):
        return None


def _device_of(node: Any, params: Any) -> str:
    """Return the device that a node such as joy_node is told to read; or ""."""
    try:
        words = shlex.split(node.args or "")
    except ValueError:  # such as an unclosed quote; see HandoutLaunch.words_of
        words = []
    in_args = [word[len("_dev:=") :] for word in words if word.startswith("_dev:=")]
    in_file = params.get(f"{node.namespace}{node.name}/dev")
    return in_args[0] if in_args else str(in_file.value) if in_file else ""


def place_of_tag(file: str, tag: Element) -> tuple[str, int]:
    """Return (file, line) of a tag; minidom knows only its position among the tags."""
    assert tag.ownerDocument
    lines: list[int] = []
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda *_: lines.append(parser.CurrentLineNumber)
    parser.Parse(Path(file).read_bytes(), True)
    return file, lines[tag.ownerDocument.getElementsByTagName("*").index(tag)]


def fault_of(error: BaseException, path: str) -> dict[str, object]:
    """Return the fields of Fault for an error of roslaunch. path: the launch file."""
    chain = [error]
    while chain[-1].__context__:
        chain.append(chain[-1].__context__)
    frames = [frame for cause in chain for frame, _ in traceback.walk_tb(cause.__traceback__)]
    # roslaunch calls the tag of a <remap> in a <node> t.
    key = "t" if any(frame.f_code.co_name == "add_remap" for frame in frames) else "tag"
    places, name = [(path, 1)], ""
    for about in (frame.f_locals for frame in frames if "xmlloader" in frame.f_code.co_filename):
        path, tag = about.get("filename", path), about.get(key) or about.get("tag")
        if tag and "context" in about:
            places.append(place_of_tag(about["context"].filename, tag))
            name = tag.tagName
    cause = next((c for c in reversed(chain) if not isinstance(c, KeyError)), error)
    if isinstance(cause, expat.ExpatError):
        places.append((path, cause.lineno))
    words = str(cause.args[0] if len(cause.args) == 1 else cause)  # without ROS's paths
    return {"kind": type(cause).__name__, "words": words, "tag": name, "places": places}


def _node(node: Any, params: Any) -> dict[str, object]:
    plain = ("package", "type", "name", "namespace", "filename")
    return {
        **{name: getattr(node, name) for name in plain},
        "args": node.args or "",
        "remaps": list(map(list, node.remap_args)),
        "respawn": bool(node.respawn),
        "device": _device_of(node, params),
        "found": can_be_found(node.package, node.type),
    }


def facts_of(path: str) -> dict[str, object]:
    """Return the content of a launch file; if it has an error, as far as roslaunch reads it."""
    import roslaunch.config  # noqa: PLC0415
    import roslaunch.loader  # noqa: PLC0415

    value_of = roslaunch.loader.Loader.param_value

    def without_command(self: Any, *about: Any) -> Any:
        """Run no <param command=...>: only what would be started matters."""
        *start, value, textfile, binfile, command = about
        return value_of(self, *start, value if command is None else "", textfile, binfile, None)

    roslaunch.loader.Loader.param_value = without_command
    said = io.StringIO()
    facts: dict[str, object] = {"path": path, "fault": None, "nodes": [], "files": [], "said": ""}
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            config = roslaunch.config.load_config_default([path], 11311, verbose=False)
        facts["errors"] = list(map(str, config.config_errors))
        facts["nodes"] = [_node(node, config.params) for node in config.nodes]
        facts["files"] = sorted({str(Path(file).resolve()) for file in config.roslaunch_files})
    except (Exception, SystemExit) as error:
        facts["fault"] = fault_of(error, path)
    return {**facts, "said": said.getvalue()[-2000:]}


if __name__ == "__main__":
    sys.path.pop(0)  # this folder, whose modules roslaunch must not import
    for argument in sys.argv[1:]:
        print(MARK + json.dumps(facts_of(argument)), flush=True)
