"""./tutorial ros2: Python programs with ROS 2, which is PyPI's wheels or installed here."""

from __future__ import annotations

from pathlib import Path

from node_kit.ros2_python import command
from tutorial_tools.command.downloads import ROS2
from tutorial_tools.paths import REPOSITORY

OWN = REPOSITORY / "common" / "ros2_tutorials" / "ros2_tutorials"
TOOLS = (REPOSITORY / "common" / "ros2_bridge" / "src" / "ros2_bridge" / "convert_bag.py",)


def programs() -> dict[str, Path]:
    """Return {name: path} of the tutorial's programs."""
    paths = [*sorted(OWN.glob("[a-z]*.py")), *TOOLS]
    return {path.stem: path for path in paths}


def command_of(workspace: Path, program: str | None, rest: list[str]) -> list[str]:
    """Return the command line that runs a program with ROS 2. Raises ValueError with one line."""
    words = [] if program is None else [_path_of(program), *rest]
    return command(words, str(workspace / ROS2.name / "bin" / "python"))


def _path_of(program: str) -> str:
    if Path(program).is_file():
        return str(Path(program).resolve())
    if program in programs():
        return str(programs()[program])
    raise ValueError(f"{program}: no such file, and none of ours: {', '.join(programs())}")
