"""Puts a robot back to where it started, by its service."""

from __future__ import annotations

import threading
from typing import ClassVar

import rospy
from std_srvs.srv import Empty

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.who_drives import Driving
from cockpit_server.graph import Graph, topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import text


def reset_service(graph: Graph, robot: str) -> str:
    """Return the service that resets this robot and no other. Raises RefusedError."""
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
    """Resets a robot that nothing else drives, when a page asks for it."""

    messages: ClassVar = {"reset": {"robot": text}}

    def __init__(self, driving: Driving, graph_watch: GraphWatch) -> None:
        self._driving, self._graphs = driving, graph_watch
        self._asked: set[str] = set()  # names of services that have not answered yet

    def on_reset(self, client: Client, _now: float, robot: str) -> None:
        self._driving.must_rest(client, robot)
        name = reset_service(self._graphs.graph, robot)
        if name in self._asked:
            raise RefusedError(f"{name} was called and has not answered yet")
        self._asked.add(name)
        # A thread of its own: a robot that hangs does not answer, and other robots go on.
        threading.Thread(target=self._call, args=(name,), daemon=True).start()

    def _call(self, name: str) -> None:
        try:
            rospy.ServiceProxy(name, Empty)()
        except rospy.ServiceException as error:
            rospy.logwarn("cockpit: %s: %s", name, error)
        finally:
            self._asked.discard(name)
