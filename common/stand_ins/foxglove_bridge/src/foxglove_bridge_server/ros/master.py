"""Questions of the bridge to its master."""

from __future__ import annotations

from typing import Any

import rosgraph
import rospy

from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer


def ask(method: str, *arguments: Any) -> tuple[Answer, Any]:
    """Call a method of the master; return (Answer, value or None)."""
    return call(rosgraph.get_master_uri(), method, *arguments, caller=rospy.get_name())


def kind_of_others(topic: str, ours: str) -> str:
    """Return the type that the master has for a topic, or "" if no other node uses it.

    ours: the last type that this node has published there, which the master keeps.
    """
    (_, state), (_, kinds) = ask("getSystemState"), ask("getTopicTypes")
    kind = str(dict(kinds or ()).get(topic, "*"))
    columns = (state or ())[: 1 if kind == ours else 2]  # publishers, subscribers
    users = {
        user for column in columns for name, nodes in column if name == topic for user in nodes
    }
    return kind if kind != "*" and users - {rospy.get_name()} else ""
