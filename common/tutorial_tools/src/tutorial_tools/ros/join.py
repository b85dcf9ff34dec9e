"""The command join: checks the connection to the teacher's machine, then starts student.launch."""

from __future__ import annotations

import os
import re
import sys

import rospkg

from launch_kit.arguments import written_out
from launch_kit.ros.launch_tree import checked
from node_kit.ros.graph.ros_api import way_out
from node_kit.rules.answer import Answer
from tutorial_tools.classroom import START, check_robot, host_and_port
from tutorial_tools.command.subcommands import fail, parser_of
from tutorial_tools.errors import JoinError
from tutorial_tools.ros.doctor.network import addresses, call, is_called_back, is_here


def check_host(host: str) -> tuple[str, str]:
    """Return (the master's URI, this machine's address on the way there). Raises JoinError."""
    name, port = host_and_port(host)
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
    answer, value = call(uri, "getParam", "/run_id")  # roslaunch names its log folder by it
    if answer is Answer.WELL and not (isinstance(value, str) and re.fullmatch(r"[\w-]+", value)):
        raise JoinError(f"the master {uri} has a /run_id that is no name: {ascii(value)[:60]}")


def main() -> None:
    """Check everything, then replace this process with roslaunch."""
    options = parser_of("join").parse_args()
    file = f"{rospkg.RosPack().get_path('joy2twist')}/launch/student.launch"
    try:
        arguments = [f"name:={options.name}", *written_out(options.arguments)]
        name = checked(file, arguments).values()["name"]
        if name != options.name:
            raise ValueError(f"name:={name}: the name is {options.name} already")
        uri, own = check_host(options.host)
        check_master(uri, own)
        check_robot(uri, call(uri, "getSystemState")[1], options.name)
    except ValueError as error:
        fail(f"join: {error}")
    except JoinError as error:
        sys.exit(f"join: {error}")
    environment = {name: value for name, value in os.environ.items() if name != "ROS_HOSTNAME"}
    environment.update(ROS_MASTER_URI=uri, ROS_IP=own)
    print(f"join: ROS_MASTER_URI={uri} ROS_IP={own}", flush=True)
    os.execvpe("roslaunch", ["roslaunch", "joy2twist", "student.launch", *arguments], environment)
