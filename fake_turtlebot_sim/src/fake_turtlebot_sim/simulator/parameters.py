"""The private parameters of the simulator and their checks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import inf, pi, tau
from typing import Any, Mapping

from fake_turtlebot_sim.simulator.differential_drive import Pose
from fake_turtlebot_sim.simulator.world import FARTHEST_PLACE_M, World
from fake_turtlebot_sim.simulator.world_files import find_world, read_world
from node_kit.parameters.declaration import (
    checked,
    declared,
    is_number,
    number,
    parameter,
    switch,
    text,
    whole_number,
)

MOST_ROBOTS = 1000

# tf2 allows no leading slash.
_FRAME = text(
    "a name without blanks and leading slash", lambda value: re.fullmatch(r"[^/\s]\S*", value)
)
_LENGTH = number(-FARTHEST_PLACE_M, FARTHEST_PLACE_M, "m, or empty", off="")
FASTEST = 1000.0  # [m/s, rad/s] where no limit is set
_ACCELERATION = number(0.0, 1000.0, "m/s2 (0: no limit)")
_ANGULAR_ACCELERATION = number(0.0, 1000.0, "rad/s2 (0: no limit)")


def _robots(value: Any) -> dict[str, Pose | None]:
    """Return {name: pose}; for a list of names or a number of robots the poses are None."""
    if isinstance(value, dict):
        return {_robot_name(robot): _robot_pose(robot, pose) for robot, pose in value.items()}
    if isinstance(value, (list, tuple)) and 1 <= len(value) <= MOST_ROBOTS:
        names = list(map(_robot_name, value))
        for robot in names:
            if names.count(robot) > 1:
                raise ValueError(f"{robot!r}: is listed twice; must be unique")
        return dict.fromkeys(names)
    if is_number(value) and value in range(1, MOST_ROBOTS + 1):
        return {f"robot_{k + 1}": None for k in range(int(value))}
    raise ValueError(
        f"must be a number from 1 to {MOST_ROBOTS}, names as in [ada, bob], or"
        " names with their start poses as in {ada: [0, 0, 0], bob: [1, 0, 1.57]}"
    )


def _robot_name(robot: Any) -> str:
    if not isinstance(robot, str) or not re.fullmatch(r"[A-Za-z]\w*", robot, re.ASCII):
        raise ValueError(f"{robot!r}: must be a letter followed by letters, digits and underscores")
    return robot


def _robot_pose(robot: str, pose: Any) -> Pose:
    is_list = isinstance(pose, (list, tuple)) and len(pose) == 3
    if not (is_list and all(is_number(v) and abs(v) <= FARTHEST_PLACE_M for v in pose)):
        raise ValueError(f"{robot}: {pose!r}: must be [x in m, y in m, yaw in rad], up to 1e6")
    x, y, yaw = map(float, pose)
    return x, y, yaw


def line_up(count: int) -> list[Pose]:
    """Return poses in rows of ten, 1 m apart, the first at the origin."""
    return [(float(-(k // 10)), float(-(k % 10)), 0.0) for k in range(count)]


def _world(value: Any) -> World | None:
    """Return the World of a file, or of this package by its name; None for ""."""
    if not isinstance(value, str):
        raise ValueError("must be a file, or the name of a world of this package")
    return read_world(find_world(value)) if value else None


@dataclass(frozen=True)
class SimulatorParameters:
    """The parameters with their defaults; README.md has them as a table."""

    rate: float = parameter(50.0, number(5, 1000, "Hz"), "of odometry, transform and wheels")
    cmd_vel_timeout: float = parameter(
        0.6, number(0.02, 60.0, "s, or 0: never", off=0.0), "after which a command expires"
    )
    publish_tf: bool = parameter(
        True, switch, "false leaves the transform to another node, such as a filter"
    )
    kobuki: bool = parameter(False, switch, "with a [Kobuki's other topics](#the-kobuki)")
    wheel_separation: float = parameter(0.23, number(0.01, 10.0, "m"))
    wheel_radius: float = parameter(0.035, number(0.001, 5.0, "m"))
    max_linear_speed: float = parameter(0.7, number(0.01, 100.0, "m/s, or 0: 1000", off=0.0))
    max_angular_speed: float = parameter(
        pi, number(0.01, 100.0, "rad/s, or 0: 1000", off=0.0), "180 deg/s", "pi"
    )
    max_linear_acceleration: float = parameter(
        0.0, _ACCELERATION, "with a limit the robot also needs time to stop"
    )
    max_angular_acceleration: float = parameter(0.0, _ANGULAR_ACCELERATION)
    initial_x: float | str = parameter("", _LENGTH, "start pose; all empty: the world's start")
    initial_y: float | str = parameter("", _LENGTH)
    initial_yaw: float | str = parameter("", number(-tau, tau, "rad, or empty", off=""))
    odom_frame: str = parameter("odom", _FRAME)
    base_frame: str = parameter("base_footprint", _FRAME)
    left_wheel_joint: str = parameter("wheel_left_joint", _FRAME)
    right_wheel_joint: str = parameter("wheel_right_joint", _FRAME)
    wheel_noise: float = parameter(
        0.0,
        number(0.0, 1.0, "m (standard deviation after 1 m)"),
        "of a wheel's measured travel; grows with the square root of the distance",
    )
    wheel_radius_ratio: float = parameter(
        1.0, number(0.5, 2.0, "(right / left)"), "of the actual wheels, UMBmark's E_d"
    )
    track_ratio: float = parameter(
        1.0, number(0.5, 2.0, "(actual / nominal)"), "of the wheel separation, UMBmark's E_b"
    )
    seed: int = parameter(0, whole_number(), "the same seed (and name) gives the same noise")
    robots: dict[str, Pose | None] = parameter(
        {}, _robots, "several: a number, `[ada, bob]`, or `{ada: [x, y, yaw], ...}` [m, m, rad]"
    )
    world_frame: str = parameter("world", _FRAME, "common to the odometry frames of several robots")
    world: World | None = parameter(
        None, _world, "to drive in: `room`, `maze`, `table`, or a file; empty: an empty plane", '""'
    )
    map_frame: str = parameter("map", _FRAME, "that of the world")
    robots_meet: bool = parameter(True, switch, "in a world the robots touch and see each other")
    scan_rate: float = parameter(
        10.0, number(0.1, 1000.0, "Hz, or 0: no scan", off=0.0), "of the laser scanner in a world"
    )
    scan_frame: str = parameter("camera_depth_frame", _FRAME)
    publish_scan_tf: bool = parameter(
        True, switch, "false where the robot's model has the scanner's frame"
    )
    scan_x: float = parameter(-0.087, number(-10.0, 10.0, "m"), "of the scanner, ahead of the base")
    scan_y: float = parameter(0.0125, number(-10.0, 10.0, "m"), "to the left")
    scan_angle: float = parameter(58 * pi / 180, number(0.001, tau, "rad"), "58 deg", "1.0123")
    scan_beams: int = parameter(
        640, whole_number(1, 10_000, "a whole number from 1 to 10000"), "over the angle"
    )
    scan_range_min: float = parameter(0.45, number(0.0, 100.0, "m"), "nearer is -inf, or NaN")
    scan_range_max: float = parameter(10.0, number(0.01, 1000.0, "m"), "farther is inf, or NaN")
    scan_no_return: str = parameter(
        "inf",
        text("inf or nan", ("inf", "nan").__contains__),
        "the range of a beam without an obstacle: by REP-117, or as on a real TurtleBot 2",
    )
    scan_noise: float = parameter(
        0.0, number(0.0, 10.0, "m (standard deviation)"), "of each range; the seed determines it"
    )

    def period_ns(self) -> int:
        """Return the time between two messages [ns]."""
        return round(10**9 / self.rate)

    def meeting_reach(self) -> float:
        """Return the distance [m] beyond which two robots cannot touch in their next steps."""
        if not (self.cmd_vel_timeout and self.max_linear_speed):
            return inf
        longest_s = self.cmd_vel_timeout + 10.0 / self.rate  # steps are longer on a busy machine
        return 1.0 + 2.0 * self.max_linear_speed * longest_s

    def start_poses(self) -> dict[str, Pose]:
        """Return {name: pose}; without ~robots the name is "". Raises ValueError."""
        poses = self.given_poses()
        count = list(poses.values()).count(None)
        places = self.world.places(count) if self.world and count else line_up(count)
        return {name: pose or places.pop(0) for name, pose in poses.items()}

    def given_poses(self) -> Mapping[str, Pose | None]:
        """Return the start poses that are given; None where one must still be chosen."""
        initial = self.initial_x, self.initial_y, self.initial_yaw
        x, y, yaw = (float(value or 0.0) for value in initial)
        return self.robots or {"": (x, y, yaw) if set(initial) != {""} else None}


def simulated(name: str) -> Any:
    """Declare a parameter of another program that the simulator has, too."""
    declaration = declared(SimulatorParameters)[name]
    meta = declaration.metadata
    return parameter(declaration.default, meta["check"], meta["meaning"], meta["default"])


def parse_parameters(given: Mapping[str, Any]) -> SimulatorParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    parameters = SimulatorParameters(**checked(SimulatorParameters, given))
    for left, right in (("odom_frame", "base_frame"), ("left_wheel_joint", "right_wheel_joint")):
        value = getattr(parameters, left)
        if value == getattr(parameters, right):
            raise ValueError(f"~{right}: {value!r}: must differ from ~{left}")
    if parameters.scan_range_min >= parameters.scan_range_max:
        raise ValueError("~scan_range_min: must be less than ~scan_range_max")
    if parameters.world:
        try:
            for pose in parameters.start_poses().values():
                parameters.world.check_place(pose)
        except ValueError as error:
            todo = "give another place, with start: in the world's file or x:= y:="
            line = f"~world: {given['world']!r}: {error}; {todo}"
            raise ValueError(line) from None
    return parameters
