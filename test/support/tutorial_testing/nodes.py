"""Nodes that tests start, the test's own node, and messages."""

from functools import lru_cache
from io import BytesIO

import rosgraph
import roslib.packages
import rospy

from node_kit.ros.graph.ros_api import call
from node_kit.ros.rospy_patches.connections import connect_once
from tutorial_testing.waiting import wait_for


@lru_cache(maxsize=None)
def node_path(package, name):
    """Return the path of a node's program, as roslaunch finds it.

    rosrun finds the same one, but takes half a second, about as long as the node takes to start.
    """
    return roslib.packages.find_node(package, name)[0]


def pid_of(node):
    """Wait for a node; return its process."""

    def ask():
        uri = call(rosgraph.get_master_uri(), "lookupNode", node)[1]
        return uri and call(uri, "getPid")[1]

    return wait_for(ask, f"process of {node}")


def init_node(name, **options):
    """Call rospy.init_node(), without a race in rospy that could fail the test."""
    connect_once()
    rospy.init_node(name, **options)


def serialised(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
