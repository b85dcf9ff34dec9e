"""The nodes that tests start."""

from functools import lru_cache

import roslib.packages


@lru_cache(maxsize=None)
def node_path(package, name):
    """The path of a node's program, found as roslaunch finds it.

    rosrun finds the same, but works for half a second, about as long as the node itself to start.
    """
    return roslib.packages.find_node(package, name)[0]
