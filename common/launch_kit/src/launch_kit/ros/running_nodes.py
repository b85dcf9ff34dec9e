"""Nodes that run already and are in the way of a launch."""

from __future__ import annotations

import os
from collections.abc import Iterable

from launch_kit.names import in_the_way
from node_kit.ros.graph.ros_api import MASTER_S, call, holder
from node_kit.rules.answer import Answer

DEFAULT_MASTER = "http://localhost:11311"


def master_uri() -> str:
    """Return the address of the user's master."""
    return os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER


def held_names(nodes: Iterable[str], topics: Iterable[str] = ()) -> dict[str, str]:
    """Return the names in the way of a launch, with where their nodes run.

    The name of a node that has died is free, although the master still knows it.
    """
    answer, state = call(master_uri(), "getSystemState", timeout_s=MASTER_S)
    names = in_the_way(state, nodes, topics) if answer is Answer.WELL else []
    places = {name: holder(master_uri(), name) for name in names}
    return {name: place[1] for name, place in places.items() if place}
