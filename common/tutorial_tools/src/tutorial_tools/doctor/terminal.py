"""What a terminal and a workspace bring along, by the standard library alone: ROS may be hidden."""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from node_kit.manifests import manifests
from tutorial_tools.doctor.facts import Python, Terminal

SYSTEMS = "/usr/bin/python3"  # to which ROS 1 belongs
# The PATH with which ./tutorial was called; it puts the system's Python first.
PATH = "TUTORIAL_TERMINAL_PATH"
MODULES = ("rospkg", "catkin_pkg", "em")  # without which nothing is found, nor a message built
PROBE = f"""
import importlib.util, json
found = {{name: importlib.util.find_spec(name) for name in {MODULES}}}
print(json.dumps({{name: spec.origin if spec else "" for name, spec in found.items()}}))"""
LONGEST_S = 5.0


def terminal(workspace: str) -> Terminal:
    """Return what this terminal has, and how a workspace ("": none) was built."""
    path = os.environ.get(PATH) or os.environ.get("PATH", "")
    first = shutil.which("python3", path=path) or SYSTEMS
    pythons = [python(one) for one in dict.fromkeys((first, SYSTEMS)) if os.path.exists(one)]
    here = Path(workspace or os.devnull)
    cache = _text(here / "build" / "CMakeCache.txt")
    source = re.search("^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.M)
    return Terminal(
        pythons=[one for one in pythons if one],
        ros2=os.environ.get("AMENT_PREFIX_PATH", ""),
        built_by=_text(here / "build" / ".built_by").strip(),
        built_from=source[1] if source else "",
        crlf=_crlf(here / "src") if workspace else [],
    )


def python(path: str) -> Python | None:
    """Return where a Python finds the modules of ROS; None if it does not answer."""
    with contextlib.suppress(OSError, ValueError, subprocess.SubprocessError):
        command = [path, "-c", PROBE]
        said = subprocess.run(command, capture_output=True, timeout=LONGEST_S, check=True).stdout
        origins = json.loads(said)
        return Python(path, origins, "RAW_OPT" in _text(Path(origins["em"] or os.devnull)))
    return None


def leave_ros2() -> None:
    """Let this program not find the modules of ROS 2, which have the names of those of ROS 1."""
    prefixes = tuple(filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(":")))
    sys.path[:] = [entry for entry in sys.path if not entry.startswith(prefixes or ("\0",))]


def _crlf(src: Path) -> list[str]:
    """Return the programs whose first line ends as Windows ends it."""
    scripts = [path for found in manifests(src) for path in found.parent.glob("*/*")]
    return [str(path) for path in scripts if re.match("#!.*\r\n", _text(path))]


def _text(path: Path) -> str:
    """Return the text of a file; "" if there is none."""
    if path.is_file():
        with contextlib.suppress(OSError), open(path, errors="replace", newline="") as file:
            return file.read()
    return ""
