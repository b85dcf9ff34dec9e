"""Private parameters of the node: a mapping in, a checked and frozen Parameters out."""

import difflib
import re
from dataclasses import dataclass, field, fields
from math import inf, isfinite, pi
from typing import Dict, Tuple

from fake_turtlebot_sim.simulator.odometry_errors import ErrorModel
from fake_turtlebot_sim.simulator.simulated_robot import RobotModel
from fake_turtlebot_sim.simulator.velocity_command import VelocityLimits

MOST_ROBOTS = 1000

# Name: (least, most, unit).
RANGES = {
    "rate": (5.0, 1000.0, "Hz"),
    "cmd_vel_timeout": (0.02, 60.0, "s"),
    "wheel_separation": (0.01, 10.0, "m"),
    "wheel_radius": (0.001, 5.0, "m"),
    "max_linear_speed": (0.01, 100.0, "m/s"),
    "max_angular_speed": (0.01, 100.0, "rad/s"),
    "max_linear_acceleration": (0.0, 1000.0, "m/s2 (0: no limit)"),
    "max_angular_acceleration": (0.0, 1000.0, "rad/s2 (0: no limit)"),
    "initial_x": (-1e6, 1e6, "m"),
    "initial_y": (-1e6, 1e6, "m"),
    "initial_yaw": (-2 * pi, 2 * pi, "rad"),
    "wheel_noise": (0.0, 1.0, "m (standard deviation after 1 m)"),
    "wheel_radius_ratio": (0.5, 2.0, "(right / left)"),
    "track_ratio": (0.5, 2.0, "(actual / nominal)"),
}


@dataclass(frozen=True)
class Parameters:
    """What can be set, with the defaults; README.md and config/fake_turtlebot.yaml explain each."""

    rate: float = 50.0
    cmd_vel_timeout: float = 0.6
    publish_tf: bool = True
    wheel_separation: float = 0.230
    wheel_radius: float = 0.035
    max_linear_speed: float = 0.7
    max_angular_speed: float = pi
    max_linear_acceleration: float = 0.0
    max_angular_acceleration: float = 0.0
    initial_x: float = 0.0
    initial_y: float = 0.0
    initial_yaw: float = 0.0
    odom_frame: str = "odom"
    base_frame: str = "base_footprint"
    left_wheel_joint: str = "wheel_left_joint"
    right_wheel_joint: str = "wheel_right_joint"
    wheel_noise: float = 0.0
    wheel_radius_ratio: float = 1.0
    track_ratio: float = 1.0
    seed: int = 0
    robots: Dict[str, Tuple[float, float, float]] = field(default_factory=dict)
    world_frame: str = "world"

    def period_ns(self):
        """Return the time between two messages [ns]."""
        return round(1e9 / self.rate)

    def start_poses(self):
        """Return {name: (x, y, yaw)}; the only robot of a node without ~robots has no name."""
        return self.robots or {"": (self.initial_x, self.initial_y, self.initial_yaw)}

    def robot_model(self, name):
        """Return the RobotModel; each name draws odometry noise of its own, in company or alone."""
        limits = VelocityLimits(
            self.max_linear_speed,
            self.max_angular_speed,
            self.max_linear_acceleration or inf,
            self.max_angular_acceleration or inf,
        )
        errors = ErrorModel(
            self.wheel_radius_ratio, self.track_ratio, self.wheel_noise, f"{self.seed}/{name}"
        )
        return RobotModel(
            self.wheel_separation, self.wheel_radius, self.cmd_vel_timeout, limits, errors
        )


def parse_parameters(given):
    """Return Parameters from a mapping of names to values; names not given keep their default.

    Raises ValueError with one line: the parameter, its value and what is allowed.
    """
    known = {parameter.name: parameter.type for parameter in fields(Parameters)}
    checked = {}
    for name, value in given.items():
        if name not in known:
            raise ValueError(f"~{name}: {value!r}: no such parameter; {_suggestion(name, known)}")
        checked[name] = _CHECKS.get(known[name], _robots)(name, value)
    parameters = Parameters(**checked)
    for one, other in (("odom_frame", "base_frame"), ("left_wheel_joint", "right_wheel_joint")):
        value = getattr(parameters, one)
        if value == getattr(parameters, other):
            raise ValueError(f"~{other}: {value!r}: must differ from ~{one}")
    return parameters


def _suggestion(name, known):
    similar = difflib.get_close_matches(name, known, n=1)
    return f"did you mean ~{similar[0]}?" if similar else f"allowed: {', '.join(sorted(known))}"


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)


def _number(name, value):
    least, most, unit = RANGES[name]
    if not _is_number(value) or not least <= value <= most:
        raise ValueError(f"~{name}: {value!r}: must be a number from {least:g} to {most:g} {unit}")
    return float(value)


def _whole_number(name, value):
    if not isinstance(value, int) or isinstance(value, bool):
        raise ValueError(f"~{name}: {value!r}: must be a whole number")
    return value


def _switch(name, value):
    if not isinstance(value, bool):
        raise ValueError(f"~{name}: {value!r}: must be true or false")
    return value


def _frame(name, value):
    # tf2 knows no leading slash.
    if not isinstance(value, str) or not re.fullmatch(r"[^/\s]\S*", value):
        raise ValueError(f"~{name}: {value!r}: must be a name without blanks and leading slash")
    return value


def _robots(name, value):
    """Check {name: [x, y, yaw]}; names or a number of robots are lined up."""
    if isinstance(value, dict):
        return {_robot_name(robot): _robot_pose(robot, pose) for robot, pose in value.items()}
    if isinstance(value, (list, tuple)) and 1 <= len(value) <= MOST_ROBOTS:
        names = list(map(_robot_name, value))
        for robot in names:
            if names.count(robot) > 1:
                raise ValueError(f"~{name}: {robot!r}: stands there twice; must be unique")
        return line_up(names)
    if _is_number(value) and value in range(1, MOST_ROBOTS + 1):
        return line_up([f"robot_{k + 1}" for k in range(int(value))])
    raise ValueError(
        f"~{name}: {value!r}: must be a number from 1 to {MOST_ROBOTS}, names as in [ada, bob], or"
        " names with their start poses as in {ada: [0, 0, 0], bob: [1, 0, 1.57]}"
    )


def _robot_name(robot):
    if not isinstance(robot, str) or not re.fullmatch(r"[A-Za-z]\w*", robot, re.ASCII):
        raise ValueError(
            f"~robots: {robot!r}: must be a letter followed by letters, digits and underscores"
        )
    return robot


def _robot_pose(robot, pose):
    if not isinstance(pose, (list, tuple)) or len(pose) != 3 or not all(map(_is_number, pose)):
        raise ValueError(f"~robots/{robot}: {pose!r}: must be [x in m, y in m, yaw in rad]")
    return tuple(map(float, pose))


def line_up(names):
    """Return {name: pose}, the first at the origin, rows of ten, 1 m apart."""
    return {name: (float(-(k // 10)), float(-(k % 10)), 0.0) for k, name in enumerate(names)}


_CHECKS = {float: _number, int: _whole_number, bool: _switch, str: _frame}
