"""What in a terminal or a workspace keeps ROS 1 from starting. Imports nothing of ROS."""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from node_kit.manifests import manifests

SYSTEMS = "/usr/bin/python3"  # the Python of ROS 1
PATH = "TUTORIAL_TERMINAL_PATH"  # PATH of the calling terminal; ./tutorial puts SYSTEMS first
SCRIPTS = ("scripts", "nodes", "bin")  # a package's folders of programs
PROBE = """
import importlib.util, json
specs = {name: importlib.util.find_spec(name) for name in ("rospkg", "catkin_pkg", "em")}
print(json.dumps({name: spec.origin if spec else "" for name, spec in specs.items()}))"""


def environment(workspace: str) -> list[tuple[str, str]]:
    """Return [(what is wrong, what to do)] for this terminal and a workspace ("": none)."""
    path = os.environ.get(PATH) or os.environ.get("PATH", "")
    pythons = dict.fromkeys((shutil.which("python3", path=path) or SYSTEMS, SYSTEMS))
    complaints = [complaint for python in pythons for complaint in _of_python(python)]
    if ros2 := os.environ.get("AMENT_PREFIX_PATH"):
        todo = "open a terminal in which no setup.bash of ROS 2 is sourced; look into ~/.bashrc"
        complaints.append((f"ROS 2 is in this terminal, too (AMENT_PREFIX_PATH={ros2})", todo))
    return [*complaints, *(_of_workspace(Path(workspace)) if workspace else ())]


def leave_ros2() -> None:
    """Hide the modules of ROS 2 from this program: some have the names of ROS 1's."""
    prefixes = tuple(filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(":")))
    sys.path[:] = [entry for entry in sys.path if not entry.startswith(prefixes or ("\0",))]


def _of_python(path: str) -> Iterator[tuple[str, str]]:
    origins: dict[str, str] = {}
    with contextlib.suppress(OSError, ValueError, subprocess.SubprocessError):
        probe = [path, "-c", PROBE]
        said = subprocess.run(probe, capture_output=True, timeout=5.0, check=True).stdout
        origins = json.loads(said)
    missing = [name for name, origin in origins.items() if not origin]
    if missing:
        todo = "conda deactivate; " if re.search("conda|forge", path) else ""
        todo += f"ROS 1 belongs to {SYSTEMS}: export PATH=/usr/bin:$PATH, or ./tutorial shell"
        yield f"python3 is {path}, which has no {', '.join(missing)}", todo
    elif origins and "RAW_OPT" not in _text(Path(origins["em"])):
        todo = f"{path} -m pip uninstall em empy (--break-system-packages, if it asks for that)"
        seen = f"{path} takes em from {origins['em']}, which is not empy 3: no message is built"
        yield seen, todo


def _of_workspace(workspace: Path) -> Iterator[tuple[str, str]]:
    build, rebuild = workspace / "build", f"cd {workspace}; rm -r build devel; catkin_make"
    cache = _text(build / "CMakeCache.txt")
    source = re.search("^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.M)
    tool = _text(build / ".built_by").strip()
    if tool not in ("", "catkin_make"):
        yield f"{build} was made by {tool}, not by catkin_make", rebuild
    elif source and os.path.realpath(source[1]) != os.path.realpath(workspace / "src"):
        yield f"{build} was made for {source[1]}", rebuild
    packages = list(manifests(workspace / "src"))
    yield from _of_names(packages)
    for script in [path for package in packages for path in sorted(package.parent.glob("*/*"))]:
        yield from _of_script(script)


def _of_names(packages: list[Path]) -> Iterator[tuple[str, str]]:
    folders: dict[str, list[str]] = {}
    for package in packages:
        if match := re.search(r"<name>\s*([^<\s]+)", _text(package)):
            folders.setdefault(match[1], []).append(str(package.parent))
    for name, copies in folders.items():
        if len(copies) > 1:
            todo = f"delete one, or touch {copies[0]}/CATKIN_IGNORE"
            yield f"{len(copies)} packages have the name {name}: {', '.join(copies)}", todo


def _of_script(script: Path) -> Iterator[tuple[str, str]]:
    text = _text(script)
    if re.match("#!.*\r\n", text):
        yield f"{script} has the line ends of Windows", f"sed -i 's/\\r$//' {script}"
    if script.parent.name not in SCRIPTS:
        return
    executable = os.access(script, os.X_OK)
    if text.startswith("#!") and not executable:
        yield f"{script} is not executable", f"chmod +x {script}"
    elif executable and script.suffix == ".py" and not text.startswith("#!"):
        yield f"{script} does not begin with #!", f"sed -i '1i #!{SYSTEMS}' {script}"


def _text(path: Path) -> str:
    """Return the text of a file; "" if there is none."""
    with contextlib.suppress(OSError):
        return path.read_bytes().decode(errors="replace") if path.is_file() else ""
    return ""
