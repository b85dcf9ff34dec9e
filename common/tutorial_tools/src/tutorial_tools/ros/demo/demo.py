"""The command demo: checks, then starts launch_bag.launch, and reports what was driven.

The checks find what roslaunch reports badly or not at all: unknown arguments, a bag that cannot be
played, a port taken by another program, and nodes that run already.
"""

from __future__ import annotations

import math
import os
import signal
import socket
import sys
import time
from collections.abc import Iterable

import rosgraph
import rospkg

from launch_kit.arguments import written_out
from launch_kit.names import next_uri, own_master, refusal
from launch_kit.ros.launch_tree import checked
from launch_kit.ros.running_nodes import held_names
from node_kit.ros.graph.ros_api import accepts, call
from node_kit.rules.answer import Answer
from tutorial_tools.command.subcommands import fail, parser_of
from tutorial_tools.errors import DemoError
from tutorial_tools.ros.cockpit_page import address
from tutorial_tools.ros.demo.running_launch import ENDING, TOPICS, DemoLaunch

PAGE_TIMEOUT_S = 5.0  # tornado and rospy load on a slow and busy machine, too
WITHOUT_SCREEN = "there is no screen (DISPLAY is not set), so RViz is left out; to see it drive, "
IN_TERMINAL = "in another terminal: ./tutorial run rostopic echo /odom/pose/pose/position"


def check_master(nodes: Iterable[str]) -> None:
    """Raise DemoError if another program answers at the master's port, or nodes are in the way."""
    uri = rosgraph.get_master_uri()
    try:
        host, port = rosgraph.network.parse_http_host_and_port(uri)
    except ValueError as error:
        raise DemoError(f"ROS_MASTER_URI={uri}: not of the form http://HOST:PORT") from error
    held = held_names(nodes, TOPICS)
    if held:
        raise DemoError(refusal(uri, held))
    has_master = call(uri, "getPid")[0] is Answer.WELL
    if not has_master and accepts(uri):  # else roslaunch starts one, or refuses another host
        raise DemoError(
            f"port {port} of {host} is taken by a program that is not a ROS master; "
            f"end it, or choose another port: export ROS_MASTER_URI={next_uri(uri)}"
        )


def claim_master() -> socket.socket:
    """Return a socket that no other demo of this machine and this master has while it is open.

    Two that start at once see nothing of each other's nodes yet. The kernel forgets the name, which
    is of no file, with the process. Raises DemoError.
    """
    claim, uri = socket.socket(socket.AF_UNIX), rosgraph.get_master_uri()
    try:
        claim.bind(f"\0ros1_tutorial demo {uri}"[:100])
    except OSError as error:
        line = f"another demo runs already on {uri}: end it first, or {own_master(uri)}"
        raise DemoError(line) from error
    return claim


def where_to_look(values: dict[str, str]) -> str:
    """Return where a robot is seen without a screen. values: those of launch_bag.launch."""
    wanted = values["cockpit"].lower() not in ("false", "0")
    end = time.monotonic() + PAGE_TIMEOUT_S
    while wanted and not address(rosgraph.get_master_uri()):
        time.sleep(0.1)
        wanted = time.monotonic() < end
    if not wanted:
        return IN_TERMINAL
    port, published = values["cockpit_port"], os.environ.get("COCKPIT_PUBLISHED")
    if published:  # the port at which a container's page is found
        return f"open http://localhost:{published}/ in a browser on the container's host"
    tunnel = f"ssh -L {port}:127.0.0.1:{port} {socket.gethostname()}"
    return f"open http://127.0.0.1:{port}/ in a browser; from another machine: {tunnel}"


def main() -> None:
    """Check, then launch; exit code 0 if it ran and, with --for, if the robot moved."""
    for number in ENDING:
        signal.signal(number, signal.default_int_handler)
    options = parser_of("demo").parse_args()
    launch, interrupted, began_s = None, False, time.monotonic()
    try:
        launch_file = f"{rospkg.RosPack().get_path('joy2twist')}/launch/launch_bag.launch"
        arguments = written_out(options.arguments)
        tree = checked(launch_file, arguments)
        values, nodes = tree.values(), [node.name for node in tree.nodes]
        with_rviz = values["rviz"].lower() in ("true", "1")
        check_master(nodes)
        command = ["roslaunch", launch_file, *arguments]
        with claim_master(), DemoLaunch(command, nodes) as launch:
            launch.wait_for_odometry()
            print(f"demo: first /odom after {time.monotonic() - began_s:.1f} s", flush=True)
            given = any(argument.startswith("rviz:=") for argument in options.arguments)
            if not with_rviz and not given:
                print(f"demo: {WITHOUT_SCREEN}{where_to_look(values)}", flush=True)
            launch.watch(math.inf if options.duration_s is None else options.duration_s)
    except ValueError as error:
        fail(f"demo: {error}")
    except DemoError as error:
        sys.exit(f"demo: {error}")
    except KeyboardInterrupt:
        interrupted = True
    if launch and launch.summary:
        print(f"demo: {launch.summary}")
    if interrupted or not launch:
        sys.exit(130 if options.duration_s else 0)  # without a time, this is how it ends
    sys.exit(not launch.report.moved)
