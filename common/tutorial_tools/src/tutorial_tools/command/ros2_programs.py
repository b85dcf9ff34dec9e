"""./tutorial ros2: Python programs with ROS 2, which is PyPI's wheels or installed here."""

from __future__ import annotations

from pathlib import Path

from node_kit.ros2_python import command
from tutorial_tools.paths import REPOSITORY

NAME, REQUIREMENTS = "ros2", "common/ros2_tutorials/requirements.txt"
BUILD = f"alone={NAME}:{REQUIREMENTS}"
SIZE = "290 MB"
PYTHONS = ((3, 10), (3, 14))  # the first and the last that have wheels
MACHINE = "x86_64"
OWN = REPOSITORY / "common" / "ros2_tutorials" / "ros2_tutorials"
TOOLS = (REPOSITORY / "common" / "ros2_bridge" / "src" / "ros2_bridge" / "convert_bag.py",)


def programs() -> dict[str, Path]:
    """Return {name: path} of the tutorial's programs."""
    paths = [*sorted(OWN.glob("[a-z]*.py")), *TOOLS]
    return {path.stem: path for path in paths}


def why_no_wheels(machine: str, python: tuple[int, int]) -> str:
    """Return why PyPI has no ROS 2 for this machine and Python; "" if it has."""
    if machine == MACHINE and PYTHONS[0] <= python <= PYTHONS[1]:
        return ""
    here = f"{machine} with Python {python[0]}.{python[1]}"
    there = f"{MACHINE} with Python 3.{PYTHONS[0][1]} to 3.{PYTHONS[1][1]}"
    return f"PyPI has no ROS 2 for {here}, only for {there}; or install ROS 2 itself"


def command_of(workspace: Path, program: str | None, rest: list[str]) -> list[str]:
    """Return the command line that runs a program with ROS 2. Raises ValueError with one line."""
    words = [] if program is None else [_path_of(program), *rest]
    return command(words, str(workspace / NAME / "bin" / "python"))


def _path_of(program: str) -> str:
    if Path(program).is_file():
        return str(Path(program).resolve())
    if program in programs():
        return str(programs()[program])
    raise ValueError(f"{program}: no such file, and none of ours: {', '.join(programs())}")
