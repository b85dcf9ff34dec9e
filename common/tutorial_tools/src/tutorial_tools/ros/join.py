"""The command join: check the way to the teacher's machine, then start student.launch."""

from __future__ import annotations

import os
import re
import sys
from typing import Any

import rospkg

from launch_kit.arguments import written_out
from launch_kit.ros.launch_tree import checked
from node_kit.ros.graph.ros_api import way_out
from node_kit.rules.answer import Answer
from tutorial_tools.command.subcommands import fail, parser_of
from tutorial_tools.doctor.facts import some
from tutorial_tools.errors import JoinError
from tutorial_tools.ros.doctor.network import addresses, call, is_called_back, is_here

DEFAULT_PORT = 11311
START = "has the teacher started classroom.launch?"


def check_host(host: str) -> tuple[str, str]:
    """Return (the master's URI, this machine's address on the way there). Raises JoinError."""
    found = re.fullmatch(r"([\w.-]+)(?::(\d{1,5}))?", host, re.ASCII)
    if not found:
        raise JoinError(f"{host}: must be a machine's name or address, such as 192.168.1.5[:11311]")
    name, port = found[1], int(found[2] or DEFAULT_PORT)
    known = addresses(name)
    if not known:
        raise JoinError(f"{name} cannot be looked up: write its address, or add it to /etc/hosts")
    own = "127.0.0.1" if all(map(is_here, known)) else way_out(known[0])
    if not own:
        raise JoinError(f"there is no way to {name}: look at cable and Wi-Fi, try: ping {name}")
    return f"http://{name}:{port}", own


def check_master(uri: str, own: str) -> None:
    """Raise JoinError unless a master answers there, reaches this machine and is one of ROS."""
    answer, _ = call(uri, "getPid")
    if answer is not Answer.WELL:
        raise JoinError(f"the master {uri} {answer.value}: {START}")
    if not is_called_back(uri, own):
        todo = "open its firewall, or join through the same network"
        raise JoinError(f"the master {uri} does not reach this machine at {own}: {todo}")
    answer, value = call(uri, "getParam", "/run_id")  # roslaunch makes a folder for logs of it
    if answer is Answer.WELL and not (isinstance(value, str) and re.fullmatch(r"[\w-]+", value)):
        raise JoinError(f"the master {uri} has a /run_id that is no name: {ascii(value)[:60]}")


def _topics(part: Any) -> dict[str, list[str]]:
    """Return {topic: its nodes} of what a master answers. Raises ValueError, TypeError."""
    for topic, nodes in part:
        if not all(isinstance(name, str) and name.isprintable() for name in (topic, *nodes)):
            raise ValueError
    return dict(part)


def check_robot(uri: str, name: str) -> None:
    """Raise JoinError unless a robot of that name waits for a driver."""
    _, state = call(uri, "getSystemState")
    try:
        publishers, subscribers, _ = map(_topics, state) if state is not None else ({}, {}, {})
    except (TypeError, ValueError):
        raise JoinError(f"the master {uri} does not answer as one of ROS") from None
    robots = [topic.split("/")[1] for topic in subscribers if re.fullmatch(r"/\w+/cmd_vel", topic)]
    if name not in robots:
        there = f"there are {some(robots)}" if robots else f"no classroom runs there: {START}"
        raise JoinError(f"{name} is not there; {there}")
    drivers = publishers.get(f"/{name}/cmd_vel")
    if drivers:
        raise JoinError(f"{name} is driven already, by {some(drivers)}; take another robot")


def main() -> None:
    """Check, then become roslaunch."""
    options = parser_of("join").parse_args()
    file = f"{rospkg.RosPack().get_path('joy2twist')}/launch/student.launch"
    try:
        arguments = [f"name:={options.name}", *written_out(options.arguments)]
        name = checked(file, arguments).values()["name"]
        if name != options.name:
            raise ValueError(f"name:={name}: the name is {options.name} already")
        uri, own = check_host(options.host)
        check_master(uri, own)
        check_robot(uri, options.name)
    except ValueError as error:
        fail(f"join: {error}")
    except JoinError as error:
        sys.exit(f"join: {error}")
    environment = {name: value for name, value in os.environ.items() if name != "ROS_HOSTNAME"}
    environment.update(ROS_MASTER_URI=uri, ROS_IP=own)
    print(f"join: ROS_MASTER_URI={uri} ROS_IP={own}", flush=True)
    os.execvpe("roslaunch", ["roslaunch", "joy2twist", "student.launch", *arguments], environment)
