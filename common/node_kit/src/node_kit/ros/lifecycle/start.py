"""The start of a node: a mistake gives one line and exit code 1, and affects no running node."""

from __future__ import annotations

import functools
import re
import sys
from typing import Any, Callable, Collection

import rosgraph
import rospy
from rospy.client import load_command_line_node_params

from node_kit.errors import StartError
from node_kit.parameters.declaration import checked_value, switch
from node_kit.printable import printable
from node_kit.ros.graph.ros_api import call, holder
from node_kit.ros.lifecycle.announcement import Announcement, full_name
from node_kit.ros.lifecycle.ending import (
    end_in_time,
    end_on_signals,
    is_ending,
    wait_for_goodbye,
)
from node_kit.ros.rospy_patches.connections import be_careful
from node_kit.ros.rospy_patches.shutdown import end_only_if_replaced
from node_kit.rules.answer import Answer

TAKE_OVER = "take_over"  # private parameter of every node with keeps_name


def run(
    name: str,
    load: Callable[[dict[str, Any]], Any],
    main: Callable[[Any], object],
    keeps_name: bool = False,
    announcement: Announcement | None = None,
) -> int:
    """Run a node: main(load(private parameters)); return its exit code.

    name: the default, unless __name:= is given. load: takes a dict of the private parameters, and
    raises ValueError with one line. main: runs once the node is registered, until it is shut down.
    keeps_name: do not start if another node has the name. announcement: services that this process
    has already registered.

    Everything is checked before rospy.init_node(), which ends a running node of the same name. The
    parameters of the command line do not go to the master, where they would stay.
    """
    own_name = name
    stored: set[str] = set()
    try:
        own_name = full_name(name)
        _check_master()
        given, stored = _parameters(own_name)
        take_over = checked_value(f"~{TAKE_OVER}", given.pop(TAKE_OVER, False), switch)
        parameters = load(given)
        if keeps_name and not take_over:
            _check_name(own_name)
    except StartError as error:
        return _fail(name, error)
    except ValueError as error:
        return _fail(name, f"{error} (~ stands for {own_name}/){remedy(error, own_name, stored)}")
    end_on_signals()
    end_only_if_replaced()
    be_careful()
    try:
        port = announcement.node_port if announcement else 0
        argv = _without_parameters(sys.argv)
        rospy.init_node(name, argv=argv, disable_signals=True, xmlrpc_port=port)
        end_in_time()
        main(parameters)
    except rospy.ROSException:
        # The node was shut down while it started, or while it published.
        if not is_ending():
            raise
    if is_ending():
        wait_for_goodbye()
    return 0


def private_parameters(name: str) -> dict[str, Any]:
    """Return the private parameters of the command line, and otherwise of the master, if any.

    For a program that needs no master. Raises StartError or ValueError, one line.
    """
    return _parameters(full_name(name))[0]


def as_callback(function: Callable[..., object]) -> Callable[..., None]:
    """Return the function as a callback that ignores the errors of a node's shutdown."""

    @functools.wraps(function)
    def call_it(*arguments: Any) -> None:
        try:
            function(*arguments)
        except rospy.ROSException:
            if not is_ending():
                raise

    return call_it


def _fail(name: str, why: object) -> int:
    print(printable(f"{name}: {why}"), file=sys.stderr)
    return 1


def _check_master() -> None:
    uri = rosgraph.get_master_uri()
    try:
        rosgraph.network.parse_http_host_and_port(uri)
    except ValueError:
        raise StartError(
            f"ROS_MASTER_URI is {uri!r}: must be an address such as http://localhost:11311"
        ) from None
    answer, _ = call(uri, "getPid")
    if answer is Answer.SILENT:
        raise StartError(f"the ROS master at {uri} does not answer: end it and restart roscore")
    if answer is not Answer.WELL:
        raise StartError(
            f"no ROS master at {uri}: start roscore first, or set ROS_MASTER_URI to where it runs"
        )


def remedy(error: ValueError, own_name: str, stored: Collection[str]) -> str:
    """Return how to delete the parameter that an error is about, if an earlier launch left it.

    stored: names of the private parameters that are on the master only, where a user does not see
    them.
    """
    name = re.match(r"~([^\s:/\[]+)", str(error))
    if not name or name[1] not in stored:
        return ""
    return f"; if an earlier launch left it on the master: rosparam delete {own_name}/{name[1]}"


def _parameters(full_name: str) -> tuple[dict[str, Any], set[str]]:
    """Return the private parameters, and the names of those that are on the master only.

    The command line overrides the master.
    """
    answer, given = call(rosgraph.get_master_uri(), "getParam", full_name)
    given = given if answer is Answer.WELL and isinstance(given, dict) else {}
    try:
        of_command_line = load_command_line_node_params(sys.argv)
    except rospy.ROSException as error:
        raise StartError(" ".join(str(error).split())) from None
    stored = {str(name) for name in given} - {key.split("/")[0] for key in of_command_line}
    for key, value in of_command_line.items():
        *outer, last = key.split("/")
        place = given
        for part in outer:  # a/b:=value sets an entry of a map
            if not isinstance(place.get(part), dict):
                place[part] = {}
            place = place[part]
        place[last] = value
    return given, stored


def _without_parameters(arguments: list[str]) -> list[str]:
    """Return the command line without _name:=value, which rospy would put on the master."""
    return [a for a in arguments if not (":=" in a and a.startswith("_") and a[1:2] != "_")]


def _check_name(full_name: str) -> None:
    held = holder(rosgraph.get_master_uri(), full_name)
    if held:
        raise StartError(
            f"{full_name} runs already, {held[1]}: end it (rosnode kill {full_name}), start this "
            f"one under another name (__name:=another), or in its place (_{TAKE_OVER}:=true)"
        )
