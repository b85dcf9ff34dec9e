"""Private parameters of the node: a mapping in, a checked and frozen Parameters out."""

import difflib
import re
from dataclasses import dataclass, field, fields
from math import inf, isfinite, pi
from typing import Dict, Tuple

Pose = Tuple[float, float, float]

# Name: (least, most, unit). Anything within is a number the simulation handles exactly.
RANGES = {
    "rate": (1.0, 1000.0, "Hz"),
    "cmd_vel_timeout": (0.02, 60.0, "s"),
    "wheel_separation": (0.01, 10.0, "m"),
    "wheel_radius": (0.001, 5.0, "m"),
    "max_linear_speed": (0.01, 100.0, "m/s"),
    "max_angular_speed": (0.01, 100.0, "rad/s"),
    "max_linear_acceleration": (0.01, inf, "m/s2"),
    "max_angular_acceleration": (0.01, inf, "rad/s2"),
    "initial_x": (-1e6, 1e6, "m"),
    "initial_y": (-1e6, 1e6, "m"),
    "initial_yaw": (-2 * pi, 2 * pi, "rad"),
}


@dataclass(frozen=True)
class Parameters:
    """What can be set, with the defaults; README.md and config/fake_turtlebot.yaml explain each."""

    rate: float = 50.0
    cmd_vel_timeout: float = 0.6
    wheel_separation: float = 0.230
    wheel_radius: float = 0.035
    max_linear_speed: float = 0.7
    max_angular_speed: float = pi
    max_linear_acceleration: float = inf
    max_angular_acceleration: float = inf
    initial_x: float = 0.0
    initial_y: float = 0.0
    initial_yaw: float = 0.0
    publish_tf: bool = True
    odom_frame: str = "odom"
    base_frame: str = "base_footprint"
    left_wheel_joint: str = "wheel_left_joint"
    right_wheel_joint: str = "wheel_right_joint"
    robots: Dict[str, Pose] = field(default_factory=dict)


def parse_parameters(given):
    """Return Parameters from a mapping of names to values; names not given keep their default.

    Raises ValueError with one line: the parameter, its value and what is allowed.
    """
    known = {field.name: field.type for field in fields(Parameters)}
    checked = {}
    for name, value in given.items():
        if name not in known:
            raise ValueError(f"~{name}: {value!r}: no such parameter; {_suggest(name, known)}")
        checked[name] = _check(name, value, known[name])
    parameters = Parameters(**checked)
    if parameters.odom_frame == parameters.base_frame:
        raise ValueError(
            f"~base_frame: {parameters.base_frame!r}: must differ from ~odom_frame, its parent"
        )
    if parameters.left_wheel_joint == parameters.right_wheel_joint:
        raise ValueError(
            f"~right_wheel_joint: {parameters.right_wheel_joint!r}: must differ from"
            " ~left_wheel_joint"
        )
    return parameters


def _suggest(name, known):
    similar = difflib.get_close_matches(name, known, n=1)
    return f"did you mean ~{similar[0]}?" if similar else f"allowed are {', '.join(sorted(known))}"


def _check(name, value, kind):
    if kind is float:
        return _number(name, value, *RANGES[name])
    if kind is bool:
        if not isinstance(value, bool):
            raise ValueError(f"~{name}: {value!r}: must be true or false")
        return value
    if kind is str:
        # tf2 knows no leading slash, and a name with a blank is a typing error.
        if not isinstance(value, str) or not re.fullmatch(r"[^/\s]\S*", value):
            raise ValueError(f"~{name}: {value!r}: must be a name without blanks or leading slash")
        return value
    return _robots(value)


def _number(name, value, least, most, unit):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not least <= value <= most:
        raise ValueError(f"~{name}: {value!r}: must be a number from {least:g} to {most:g} {unit}")
    return float(value)


def _robots(value):
    """Check {name: [x, y, yaw]}, or a number of robots to be named and lined up."""
    if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= 1000:
        return line_up(value)
    if not isinstance(value, dict):
        raise ValueError(
            f"~robots: {value!r}: must be a number from 1 to 1000 or a mapping"
            " of names to [x, y, yaw]"
        )
    return {_robot_name(name): _robot_pose(name, pose) for name, pose in value.items()}


def _robot_name(name):
    if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII):
        raise ValueError(f"~robots: {name!r}: a name must be letters, digits and underscores")
    return name


def _robot_pose(name, pose):
    is_list = isinstance(pose, list) and len(pose) == 3
    if not is_list or not all(isinstance(n, (int, float)) and isfinite(n) for n in pose):
        raise ValueError(f"~robots/{name}: {pose!r}: must be [x in m, y in m, yaw in rad]")
    return tuple(float(number) for number in pose)


def line_up(count):
    """Return names and start poses of count robots, ten to a row and 1 m apart."""
    return {f"robot_{k + 1}": (-float(k // 10), -float(k % 10), 0.0) for k in range(count)}
