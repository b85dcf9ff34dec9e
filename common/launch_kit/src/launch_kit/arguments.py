"""What each launch argument must be: its name, its rule and the sentence on a mistake, once.

roslaunch lets through what is wrong: "yes" counts as true here and is a mistake there, rosbag
reports a missing recording after all nodes have started, and a robot's name that does not exist
shows when nothing moves.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import yaml

from launch_kit.kinds import (
    NAME,
    Rule,
    as_number,
    choice,
    elsewhere,
    file,
    imported,
    matching,
    model_file,
    of_number,
    of_parameter,
    robot,
    whole_path,
    yaml_file,
)
from node_kit.parameters.declaration import Allowed, number, whole_number

BRIDGE = "foxglove_bridge_server.parameters:BridgeParameters"
OF_BRIDGE = (
    "address", "asset_uri_allowlist", "capabilities", "client_topic_whitelist", "max_update_ms",
    "nodelet_manager", "num_threads", "param_whitelist", "send_buffer_limit",
    "service_type_retrieval_timeout_ms", "service_whitelist", "tls", "topic_whitelist",
    "use_compression",
)  # fmt: skip
SIMULATOR = "fake_turtlebot_sim.simulator.parameters:SimulatorParameters"

true_or_false = matching("true or false", "(?i:true|false)|1|0")
parameter_switch = matching("true or false", "(?i:true|false)")  # 1 is a number to a node
port = of_number(whole_number(1, 65535), "a port, a number from 1 to 65535")
topic = matching("a topic, such as cmd_vel or /robot_1/cmd_vel", f"/?{NAME}(/{NAME})*")
path = matching("a whole path, such as /dev/input/js0", "/.+")


def recording(value: str) -> None:
    """Check for a file from which rosbag can play a joystick."""
    given = str(whole_path(value))
    try:
        imported("gamepad.ros.bags:check_topic")(given)
    except ValueError as error:  # it begins with the path
        raise ValueError(str(error).replace(f"{given}: ", "", 1)) from None


# The default of a launch file is allowed, too, such as none or an empty text.
RULES: dict[str, Rule] = {
    **{name: of_parameter(BRIDGE, name, yaml.safe_load) for name in OF_BRIDGE},
    "axis_deadman": of_number(whole_number(0), "the index of a button, from 0"),
    "bag": recording,
    "certfile": elsewhere(file),
    "cmd_vel": topic,
    "cockpit": Allowed(
        "true, false or auto", lambda value: value == "auto" or true_or_false.fits(value)
    ),
    "cockpit_port": port,
    "config": yaml_file,
    "joy_config": imported("launch_kit.ros.packages:check_preset"),
    "joy_config_path": yaml_file,
    "joy_dev": path,
    "joy_pkg": imported("launch_kit.ros.packages:check_joy_package"),
    "joy_timeout": of_number(number(0, 60), "a number up to 60 s, or 0 for off"),
    "joystick": choice("gamepad", "browser"),
    "kobuki_publish_tf": parameter_switch,
    "keyfile": elsewhere(file),
    "lan": true_or_false,
    "log_rate": of_number(number(0, 1000), "a number up to 1000 lines a second, or 0 for none"),
    "loop": true_or_false,
    "model": true_or_false,
    "mux": true_or_false,
    "mux_config": yaml_file,
    "name": robot,
    "node_name": matching("a name of letters, digits and underscores", NAME),
    "port": port,
    "prefix": matching("the name of a robot, and /", f"{NAME}/"),
    "publish_tf": parameter_switch,
    "robot": robot,
    "robots": of_parameter(SIMULATOR, "robots", yaml.safe_load),
    "ros2": true_or_false,
    "rviz": true_or_false,
    "rviz_config": elsewhere(file),
    "safety": true_or_false,
    "scan_no_return": of_parameter(SIMULATOR, "scan_no_return"),
    "scan_topic": topic,
    "serialport": path,
    "simulated": true_or_false,
    "simulation": choice("true", "false"),
    "topics": elsewhere(yaml_file),
    "urdf": model_file,
    "vigilance_timeout": of_number(number(1, 60, off=0), "a number from 1 to 60 s, or 0 for off"),
    "virtual": true_or_false,
    "world": of_parameter(SIMULATOR, "world"),
    "x": of_parameter(SIMULATOR, "initial_x", as_number),
    "y": of_parameter(SIMULATOR, "initial_y", as_number),
    "yaw": of_parameter(SIMULATOR, "initial_yaw", as_number),
}
# Arguments of the real robot's launch files that have one value here.
FIXED = {
    "3d_sensor": "kinect", "base": "kobuki", "battery": "", "camera": "camera", "robot_name": "",
    "robot_type": "", "scan_processing": "true", "stacks": "hexagons", "urdf_file": "",
}  # fmt: skip
NEEDED = ("name",)  # its default is none


class Argument(NamedTuple):
    """A launch argument as a launch file has it."""

    file: str
    name: str
    value: str
    default: str | None = None


def check(name: str, value: str) -> None:
    """Raise ValueError with one line if an argument's value is not allowed."""
    try:
        RULES.get(name, str)(value)
    except ValueError as error:
        raise ValueError(f"{name}:={value}: {error}") from None


def check_all(arguments: Iterable[Argument]) -> None:
    """Raise ValueError with one line for the first value that is not allowed."""
    arguments = list(arguments)
    given = [(a.name, a.value) for a in arguments if a.value != a.default or a.name in NEEDED]
    for name, value in dict.fromkeys(given):
        check(name, value)
    for launch_file in {argument.file for argument in arguments}:
        values = {a.name: a.value for a in arguments if a.file == launch_file}
        preset = values.get("joy_config_path", "none")
        if "none" not in (values.get("bag", "none"), preset):
            bag = str(whole_path(values["bag"]))
            imported("gamepad.ros.bags:check_recording")(bag, preset)


def without_effect(arguments: Iterable[Argument]) -> list[str]:
    """Return a line for each argument that has one value here, and was given another one."""
    given = dict.fromkeys((argument.name, argument.value) for argument in arguments)
    return [
        f"{name}:={value} is ignored: it changes nothing about the simulated robot"
        for name, value in given
        if value != FIXED.get(name, value)
    ]


def written_out(arguments: Iterable[str]) -> list[str]:
    """Return arguments with the user's home in NAME:=~/FILE, where a shell leaves it."""
    return [argument.replace(":=~/", f":={Path.home()}/", 1) for argument in arguments]


def assignment(argument: str) -> tuple[str, str]:
    """Return name and value of NAME:=VALUE; raise ValueError with one line if it is not that."""
    name, assigned, value = argument.partition(":=")
    if not assigned:
        near = argument.replace("=", ":=", 1)
        meant = f"; did you mean {near}?" if "=" in argument else ""
        raise ValueError(f"{argument}: not NAME:=VALUE, := is missing{meant}")
    return name, value


def no_argument(given: str, launch_file: str, known: Iterable[str]) -> str:
    """Return a line on NAME:=VALUE whose name is none of a launch file's arguments."""
    names = ", ".join(f"{name}:=" for name in sorted(known)) or "none"
    near = difflib.get_close_matches(re.split(":?=", given)[0], known, 1)
    meant = f"; did you mean {near[0]}:=?" if near else ""
    return f"{given}: not an argument of {Path(launch_file).name}, which has {names}{meant}"
