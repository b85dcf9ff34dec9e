"""For launch files: nothing is started while a node of one of its names runs.

    <param name="names_were_free" command="$(find node_kit)/names_free /fake_turtlebot"/>

roslaunch runs the command while it reads the file, before it starts any node or sets any parameter;
if it fails, roslaunch ends. roslaunch itself would end the node that runs, and start its own.
"""

import os
import re
import sys
from pathlib import Path

from node_kit.names import holder

DEFAULT_MASTER = "http://localhost:11311"
# With these roslaunch only tells what is in the file.
ONLY_READS = re.compile(r"--(nodes|files|args|find-node|ros-args|dump-params)\b")


def reader() -> "list[str]":
    """Return the command line of the parent: of the program that reads the launch file."""
    return Path(f"/proc/{os.getppid()}/cmdline").read_bytes().decode(errors="replace").split("\0")


def will_start(command):
    """Whether the program that reads the launch file starts its nodes on the master of all.

    command: its command line. rostest has a master of its own, roslaunch-check starts nothing.
    """
    names = [Path(word).name for word in command[:2]]
    return "roslaunch" in names and not any(map(ONLY_READS.match, command))


def complaint(names, master_uri):
    """One line about the first of the names that is held by a node, or None."""
    for name in [re.sub("/+", "/", f"/{given}") for given in names]:
        held = holder(master_uri, name)
        if held:
            return (
                f"{name} runs already, {held[1]}: end it first (Ctrl-C in its terminal, or rosnode "
                f"kill {name}), or have a master of your own (export "
                "ROS_MASTER_URI=http://localhost:11312)"
            )
    return None


def main():
    """Check the names of the command line; the output becomes the value of the parameter."""
    uri = os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER
    line = complaint(sys.argv[1:], uri) if will_start(reader()) else None
    if line:
        sys.exit(f"roslaunch: {line}")
    print("true")
