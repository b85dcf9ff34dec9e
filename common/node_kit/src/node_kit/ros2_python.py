"""The command that runs Python with ROS 2, of wheels or as it is installed. No ROS is needed here.

ROS 1 and ROS 2 cannot share a process: both have a std_msgs.
"""

from __future__ import annotations

import os
import shlex
from pathlib import Path

PYTHON = "TUTORIAL_ROS2"  # environment variable: the Python of the wheels
# What belongs to ROS 1: a path of its packages would hide those of ROS 2.
HIDDEN = ("PYTHONPATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO", "ROS_VERSION", "ROS_PACKAGE_PATH")
# Unless the user says more: nodes of ROS 2 find each other here alone, and over UDP. A process
# that is killed leaves its shared memory, half a megabyte, and locks that later ones wait for.
DEFAULTS = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}


def installed() -> str:
    """Return setup.bash of an installed ROS 2, the last one by its name; "" if there is none."""
    found = sorted(Path("/opt/ros").glob("*/share/rclpy/package.xml"))
    return str(found[-1].parents[2] / "setup.bash") if found else ""


def command(words: list[str], python: str = "", path: str = "") -> list[str]:
    """Return the command line of Python with these words.

    python: that of the wheels, if known. path: a folder to import from.
    """
    environment = [word for name in HIDDEN for word in ("-u", name)]
    environment += [
        f"{name}={value}" for name, value in DEFAULTS.items() if not os.environ.get(name)
    ]
    if path:
        environment.append(f"PYTHONPATH={path}")
    setup = installed()
    if setup:
        inner = f". {shlex.quote(setup)}; exec python3 {shlex.join(words)}"
        return ["env", *environment, "bash", "-c", inner]
    return ["env", *environment, python or os.environ.get(PYTHON, ""), *words]


def is_there() -> bool:
    """Return whether command() has a Python to run."""
    return bool(installed()) or os.path.exists(os.environ.get(PYTHON, ""))
