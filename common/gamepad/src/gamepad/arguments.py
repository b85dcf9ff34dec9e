"""Check what roslaunch lets through in the arguments of launch files: a rule for each name.

    <param name="arguments_were_good" command="$(find gamepad)/check_arguments 'bag:=$(arg bag)'"/>

roslaunch runs the command while it reads the file, and exits if it fails; it can only make a
parameter of it. (rosrun would need five times as long to find the command.) Without it "yes" counts
as true here and is a mistake there, rosbag reports a missing recording after all has started, and
a robot's name that does not exist shows when nothing drives.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Callable

from node_kit.parameters.declaration import Allowed


def recording(value: str) -> None:
    """Check for a file from which rosbag can play a joystick, or none."""
    if value == "none":
        return
    if not value.startswith("/"):
        raise ValueError("must be a whole path, as $PWD is not set")
    from gamepad.errors import BagError
    from gamepad.ros.bags import check_topic  # noqa: PLC0415  rosbag takes a while

    try:
        check_topic(value)
    except BagError as error:
        raise ValueError(str(error)[len(f"{value}: ") :]) from None


def robot(value: str) -> None:
    """Check for the name of a robot of classroom.launch, which begins its topics."""
    if not value:
        raise ValueError("is missing: which robot of the classroom, such as name:=robot_7")
    if not re.fullmatch(r"[A-Za-z]\w*", value, re.ASCII):
        near = re.sub(r"\W+", "_", value, flags=re.ASCII).strip("_")
        near = f"robot_{near}" if near[:1].isdigit() else near
        meant = f"; did you mean {near}?" if near else ""
        raise ValueError(f"must be a letter followed by letters, digits and underscores{meant}")


def preset(value: str) -> None:
    """Check for the path of a preset of joy2twist, or none."""
    path = Path(value)
    if value != "none" and not path.is_file():
        names = ", ".join(sorted(one.stem for one in path.parent.glob("*.yaml")))
        raise ValueError(f"there is none of this name; there are {names}")


def _is_port(value: str) -> bool:
    return bool(re.fullmatch(r"\d{1,5}", value)) and 1 <= int(value) <= 65535


def _is_timeout(value: str, least: float = 1.0) -> bool:
    number = float(value) if re.fullmatch(r"\d+(\.\d*)?", value) else -1
    return number == 0 or least <= number <= 60


true_or_false = Allowed("true or false", re.compile("(?i:true|false)|1|0").fullmatch)
RULES: dict[str, Callable[[str], object]] = {
    "bag": recording,
    "cockpit": Allowed(
        "true, false or auto", lambda value: value == "auto" or true_or_false.fits(value)
    ),
    "cockpit_port": Allowed("a port, a number from 1 to 65535", _is_port),
    "joy_config": preset,
    "joy_timeout": Allowed("a number up to 60 s, or 0 for off", lambda v: _is_timeout(v, 0.0)),
    "joystick": Allowed("gamepad or browser", ("gamepad", "browser").__contains__),
    "lan": true_or_false,
    "loop": true_or_false,
    "name": robot,
    "ros2": true_or_false,
    "rviz": true_or_false,
    "vigilance_timeout": Allowed("a number from 1 to 60 s, or 0 for off", _is_timeout),
    "virtual": true_or_false,
}


def check(name: str, value: str) -> None:
    """Raise ValueError with one line if an argument's value will not do."""
    try:
        RULES[name](value)
    except ValueError as error:
        raise ValueError(f"{name}:={value}: {error}") from None


def assignment(argument: str) -> tuple[str, str]:
    """Return name and value of NAME:=VALUE; raise ValueError with one line if it is not that."""
    name, assigned, value = argument.partition(":=")
    if not assigned:
        near = argument.replace("=", ":=", 1)
        meant = f"; did you mean {near}?" if "=" in argument else ""
        raise ValueError(f"{argument}: not NAME:=VALUE, := is missing{meant}")
    return name, value


def main() -> None:
    """Check NAME:=VALUE ...; exit with code 1, with a line, at the first that will not do."""
    try:
        given = dict(assignment(argument) for argument in sys.argv[1:])
        for name, value in given.items():
            check(name, value)
        if "none" not in (given.get("bag", "none"), given.get("joy_config", "none")):
            from gamepad.ros.bags import check_recording  # noqa: PLC0415  rosbag takes a while

            check_recording(given["bag"], given["joy_config"])
    except ValueError as error:
        sys.exit(f"roslaunch: {error}")
    print("true")  # roslaunch makes a parameter of it
