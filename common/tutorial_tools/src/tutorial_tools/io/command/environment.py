"""The environment of the command that ./tutorial starts."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from tutorial_tools.command.downloads import FOXGLOVE
from tutorial_tools.io.command.build import is_over_prefix, made_over
from tutorial_tools.paths import PREFIX, REPOSITORY

OTHERS = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH")  # of another workspace, from ~/.bashrc
LOCAL = ("", "localhost", "127.0.0.1")


def environment_of(workspace: Path, word: str, student: str) -> dict[str, str]:
    """Return the environment of a subcommand. student: a workspace, or "" for the suite's."""
    given = _given()
    lower, etc = workspace / "lower" / "devel", str(REPOSITORY / "common/node_kit/etc/ros")
    own = {"TUTORIAL_UNDERLAY": f"{lower}/setup.bash"}
    places = (f"{name}/lib/python3*/site-packages" for name in ("python", FOXGLOVE.name))
    from_pypi = [str(path) for place in places for path in workspace.glob(place)]
    if word in ("check", "worker", "scheduler"):
        libraries = ":".join([f"{lower}/lib/python3/dist-packages", *from_pypi])
        return {**given, **own, "PYTHONPATH": libraries, "ROS_ETC_DIR": etc}
    setup, beside = workspace / "devel" / "setup.bash", ""
    if student:  # the underlay's, if the student has built nothing over it
        made_of, own_setup = made_over(Path(student)), Path(student, "devel", "setup.bash")
        setup = own_setup if str(lower) in made_of else lower / "setup.bash"
        if setup != own_setup and is_over_prefix(made_of):
            beside = str(own_setup)
    made = _sourced(setup, beside, given)
    # ROS lets anyone in the network drive, so it stays on this machine until the user names an
    # address. Not by ROS_HOSTNAME, which overrides the ROS_IP that a user may set afterwards.
    master = re.sub("^.*?://", "", made.get("ROS_MASTER_URI", ""))
    named = made.get("ROS_IP") or made.get("ROS_HOSTNAME")
    if not named and re.split("[:/]", master)[0] in LOCAL:
        made["ROS_IP"] = "127.0.0.1"
    path = f"{workspace}/bin:/usr/bin"  # ROS needs the system's Python, whichever is first
    own.update(
        PATH=f"{path}:{made['PATH']}",
        PYTHONPATH=":".join([made.get("PYTHONPATH", ""), *from_pypi]),
        ROS_ETC_DIR=etc,  # where roscore and roslaunch look for roscore.xml
        ROS_ROOT=made.get("ROS_ROOT", etc),  # roswtf wants a folder named ros, which Debian lacks
        TUTORIAL_IN=student,
        TUTORIAL_RESULTS=str(workspace),
        TUTORIAL_ROS2=f"{workspace}/ros2/bin/python",  # exists after ./tutorial ros2
    )
    if word == "doctor":
        own["TUTORIAL_TERMINAL_PATH"] = given["PATH"]
    if word == "shell":  # for shellrc, after the user's .bashrc
        own.update(
            TUTORIAL_SETUP=str(setup), TUTORIAL_BESIDE=beside, TUTORIAL_ETC=etc, TUTORIAL_PATH=path
        )
        own["TUTORIAL_PYTHONPATH"] = own["PYTHONPATH"]
    return {**made, **own}


def environment_of_help() -> dict[str, str]:
    """Return the environment of a program that prints its help, with nothing built."""
    libraries = [str(source) for source in REPOSITORY.glob("common/*/src")]
    if PREFIX:
        libraries.append(f"{PREFIX}/lib/python3/dist-packages")
    return {**_given(), "PYTHONPATH": ":".join(libraries)}


def _given() -> dict[str, str]:
    # Not os.environ, to which Python adds LC_CTYPE if no locale is set.
    return _parse(Path("/proc/self/environ").read_bytes())


def _sourced(setup: Path, beside: str, given: dict[str, str]) -> dict[str, str]:
    """Return the environment of a setup.bash. beside: another to add with --extend, or ""."""
    kept = {name: value for name, value in given.items() if name not in OTHERS}
    script = 'beside=$1; set --; . "$0" >&2; [ -z "$beside" ] || . "$beside" --extend >&2'
    command = ["bash", "-ec", f"{script}; exec /usr/bin/env -0", str(setup), beside]
    done = subprocess.run(command, env=kept, check=False, stdout=subprocess.PIPE)
    if done.returncode:
        sys.exit(done.returncode)
    return _parse(done.stdout)


def _parse(block: bytes) -> dict[str, str]:
    return dict(re.findall("([^=\0]+)=([^\0]*)\0", os.fsdecode(block)))
