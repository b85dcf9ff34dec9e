"""Puts a robot back to where it started, by its service."""

import rospy
from std_srvs.srv import Empty

from cockpit_server.clients import Source
from cockpit_server.feeds import later
from cockpit_server.robots import topic_of
from cockpit_server.seat import RefusedError


def reset_service(graph, robot):
    """The name of the service that resets a robot and no other. Raises RefusedError."""
    own = topic_of(robot, "reset")
    if own in graph.services:
        return own
    odometry = topic_of(robot, "odom")
    for node in sorted(graph.publishers.get(odometry, ())):
        others = [t for t in graph.published if t.endswith("/odom") and node in graph.publishers[t]]
        if others == [odometry] and f"{node}/reset" in graph.services:
            return f"{node}/reset"
    raise RefusedError(f"{robot or 'this robot'} has no service that resets it")


class Resets(Source):
    """Calls the service of a robot when who may drive asks for it."""

    def __init__(self, graph_watch):
        """graph_watch: knows the services."""
        self._graphs = graph_watch
        self.handlers = {"reset": self._reset}

    def _reset(self, client, _now, robot):
        client.must_drive()
        later(rospy.ServiceProxy(reset_service(self._graphs.graph, robot), Empty))
