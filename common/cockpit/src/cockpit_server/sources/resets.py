"""Puts a robot back to where it started, by its service."""

from __future__ import annotations

from typing import ClassVar

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.who_drives import Driving
from cockpit_server.graph import Graph, topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import text
from cockpit_server.sources.forms import Forms, call


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

    def __init__(self, driving: Driving, forms: Forms, graph_watch: GraphWatch) -> None:
        self._driving, self._forms, self._graphs = driving, forms, graph_watch

    def on_reset(self, client: Client, _now: float, robot: str) -> None:
        self._driving.must_rest(client, robot)
        name = reset_service(self._graphs.graph, robot)
        self._forms.ask(client, name, lambda: call(name, {}))
