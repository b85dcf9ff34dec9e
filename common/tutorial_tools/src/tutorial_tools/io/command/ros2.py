"""./tutorial ros2: a Python program with ROS 2, of PyPI's wheels or as it is installed here."""

from __future__ import annotations

import platform
import sys
from pathlib import Path

from node_kit.ros2_python import command, installed
from tutorial_tools.io.command.build import REPOSITORY, is_done

NAME, REQUIREMENTS = "ros2", "common/ros2_tutorials/requirements.txt"
BUILD = f"alone={NAME}:{REQUIREMENTS}"
SIZE = "290 MB"
PYTHONS = ((3, 10), (3, 14))  # for which there are wheels, the first and the last
MACHINE = "x86_64"
OWN = REPOSITORY / "common" / "ros2_tutorials" / "ros2_tutorials"
TOOLS = (REPOSITORY / "common" / "ros2_bridge" / "src" / "ros2_bridge" / "convert_bag.py",)


def programs() -> dict[str, Path]:
    """Return {name: path} of the programs of the tutorial."""
    paths = [*sorted(OWN.glob("[a-z]*.py")), *TOOLS]
    return {path.stem: path for path in paths}


def must_be_possible(workspace: Path, yes: bool) -> None:
    """Ask, if something has to be installed. Raises ValueError with one line."""
    if installed() or is_done(workspace, BUILD):
        return
    version = sys.version_info[:2]
    if platform.machine() != MACHINE or not PYTHONS[0] <= version <= PYTHONS[1]:
        here = f"{platform.machine()} with Python {version[0]}.{version[1]}"
        there = f"{MACHINE} with Python 3.{PYTHONS[0][1]} to 3.{PYTHONS[1][1]}"
        raise ValueError(f"PyPI has no ROS 2 for {here}, only for {there}; or install ROS 2 itself")
    if yes:
        return
    if not sys.stdin.isatty():
        raise ValueError(f"{SIZE} from PyPI have to be installed: ./tutorial ros2 --yes ...")
    question = f"tutorial: ROS 2 is {SIZE} from PyPI, into {workspace / NAME}. Install it? [y/N] "
    print(question, end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise ValueError("nothing was installed")


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
