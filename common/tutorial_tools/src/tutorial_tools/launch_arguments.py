"""Check NAME:=VALUE arguments before roslaunch, which ignores a misspelt name."""

from __future__ import annotations

import re
from pathlib import Path

import roslaunch.arg_dump

from gamepad.arguments import RULES, assignment, check
from node_kit.launch import no_argument


def launch_arguments(launch_file: str, arguments: list[str]) -> dict[str, str]:
    """Return every argument of a launch file with its value, defaults included; bag is absolute.

    Raise ValueError with one line for an argument that is not NAME:=VALUE, is unknown, or has a
    value out of range. The bag itself is left to the caller.
    """
    known = roslaunch.arg_dump.get_args([launch_file])
    values = {name: default for name, (_, default) in known.items()}
    for argument in arguments:
        name = re.split(":?=", argument)[0]
        if "=" in argument and name not in known:
            raise ValueError(no_argument(argument, launch_file, known))
        name, values[name] = assignment(argument)
        if name in RULES and name != "bag":
            check(name, values[name])
    if values["bag"] != "none":
        values["bag"] = str(Path(values["bag"]).expanduser().absolute())
    return values
