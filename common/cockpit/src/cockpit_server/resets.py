"""Puts a robot back to where it started, by its service."""

import threading

import rospy
from std_srvs.srv import Empty

from cockpit_server.clients import Source
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
        name = reset_service(self._graphs.graph, robot)
        # A thread of its own: a robot that hangs does not answer, and others are to be driven.
        threading.Thread(target=_call, args=(name,), daemon=True).start()


def _call(name):
    try:
        rospy.ServiceProxy(name, Empty)()
    except rospy.ServiceException as error:
        rospy.logwarn("cockpit: %s: %s", name, error)
