"""What the command line of the program that reads a launch file says."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

ROSLAUNCH = "roslaunch"
# With these roslaunch only prints what is in the file.
ONLY_READS = re.compile(r"--(nodes|files|args|find-node|ros-args|dump-params)\b")


def starting(command: Sequence[str]) -> list[str]:
    """Return the words after roslaunch in a command line that starts nodes on the user's master.

    None of other programs: rostest has a master of its own, and roslaunch-check starts nothing.
    """
    names = [Path(word).name for word in command[:2]]
    if ROSLAUNCH not in names or any(map(ONLY_READS.match, command)):
        return []
    return list(command[names.index(ROSLAUNCH) + 1 :])


def given(words: Sequence[str]) -> list[str]:
    """Return NAME:=VALUE ... of a command line, but those that every ROS program takes."""
    return [word for word in words if ":=" in word and not word.startswith("_")]
