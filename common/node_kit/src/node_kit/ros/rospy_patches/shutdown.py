"""Ignores a shutdown request that a master meant for another node."""

from __future__ import annotations

import re
from typing import Any

import rosgraph
import rospy
from rospy.impl.masterslave import ROSHandler

from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

# The reason, with the node's name, that rosmaster's registrations.py sends to a replaced node.
REPLACED = re.compile(r"\[(\S*)\] Reason: new node registered with same name")
_end = ROSHandler.shutdown  # rospy's own


def end_only_if_replaced() -> None:
    """Ignore shutdown requests that are meant for another node; call before rospy.init_node().

    A node that died stays registered. When its name is used again, the master sends a shutdown
    request to its port, which may belong by then to another node, even one of another master.
    """
    ROSHandler.shutdown = _end_if_meant


def _end_if_meant(self: Any, *arguments: Any) -> Any:
    """Replace ROSHandler's; arguments: the caller's name and its reason."""
    replaced = REPLACED.search(str(arguments[-1:]))
    if replaced and (replaced[1] != rospy.get_name() or _has_its_name()):
        rospy.logwarn(
            f"A master has asked this node to shut down in place of {replaced[1]}, which died and "
            "had the same port: this node continues."
        )
        return 1, "not ended", 0
    return _end(self, *arguments)


def _has_its_name() -> bool:
    """Return whether the own master knows this node; it forgets the topics of a replaced node."""
    master, name = rosgraph.get_master_uri(), rospy.get_name()
    if call(master, "lookupNode", name) != (Answer.WELL, rospy.get_node_uri()):
        return False
    answer, state = call(master, "getSystemState")
    if answer is not Answer.WELL:
        return False
    topics = rospy.topics.get_topic_manager()
    ours = (topics.get_publications(), topics.get_subscriptions())
    return all(
        {topic for topic, _ in own} <= {topic for topic, nodes in known if name in nodes}
        for own, known in zip(ours, state)
    )
