"""The command that runs Python with ROS 2, from wheels or as installed.

ROS 1 and ROS 2 cannot share a process: both have a package std_msgs.
"""

from __future__ import annotations

import os
import shlex
from pathlib import Path

PYTHON = "TUTORIAL_ROS2"  # environment variable: the Python of the wheels
# These belong to ROS 1, whose packages would hide those of ROS 2.
HIDDEN = ("PYTHONPATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO", "ROS_VERSION", "ROS_PACKAGE_PATH")
# Unless the user sets them: nodes of ROS 2 find each other on this machine only, over UDP. A killed
# process would leave half a megabyte of shared memory, and locks that block later processes.
DEFAULTS = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}


def installed() -> str:
    """Return the setup.bash of the ROS 2 in /opt/ros whose name sorts last, or ""."""
    manifests = sorted(Path("/opt/ros").glob("*/share/rclpy/package.xml"))
    return str(manifests[-1].parents[2] / "setup.bash") if manifests else ""


def command(words: list[str], python: str = "", path: str = "") -> list[str]:
    """Return the command line of Python with these arguments.

    python: the Python of the wheels, if known. path: a folder for PYTHONPATH.
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
    """Return whether a Python with ROS 2 exists."""
    return bool(installed()) or os.path.exists(os.environ.get(PYTHON, ""))
