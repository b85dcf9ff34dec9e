"""What the master knows: nodes, topics, services, and which of them make up a robot."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Container, Dict, FrozenSet, Iterable, Iterator, Mapping, Protocol

from cockpit_server.errors import RefusedError

Column = Dict[str, FrozenSet[str]]
ODOMETRY, JOY, POSE = "nav_msgs/Odometry", "sensor_msgs/Joy", "turtlesim/Pose"
TF, TF_STATIC = "/tf", "/tf_static"


@dataclass(frozen=True)
class Graph:
    """Topics and services with their nodes, types, machines of nodes, and parameters.

    Of this node, own_name, there are only the topics that it publishes.
    """

    publishers: Column = field(default_factory=dict)
    subscribers: Column = field(default_factory=dict)
    services: Column = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    machines: dict[str, str] = field(default_factory=dict)
    parameters: list[str] = field(default_factory=list)
    own_name: str = ""

    @property
    def nodes(self) -> set[str]:
        columns = (self.publishers, self.subscribers, self.services)
        return {node for column in columns for nodes in column.values() for node in nodes}

    @property
    def published(self) -> list[str]:
        return sorted(topic for topic, nodes in self.publishers.items() if nodes)

    def joysticks(self, robot: str) -> tuple[str, ...]:
        """Return the names of the other nodes that publish a robot's joystick."""
        nodes = self.publishers.get(topic_of(robot, "joy"), frozenset())
        return tuple(sorted(nodes - {self.own_name}))

    def joystick_subscribers(self, robot: str) -> frozenset[str]:
        """Return the names of the other nodes that subscribe to a robot's joystick."""
        return self.subscribers.get(topic_of(robot, "joy"), frozenset())

    def robots_with_odometry(self) -> set[str]:
        return self._robots_with("/odom", ODOMETRY, self.publishers)

    def robots(self) -> set[str]:
        """Return all robots, by odometry or a subscriber of /joy; "" has no namespace."""
        return self.robots_with_odometry() | self._robots_with("/joy", JOY, self.subscribers)

    def robot_with(self, topic: str) -> str:
        """Return the robot of the innermost namespace around a topic, or that namespace."""
        names = [robot for robot in self.robots() if topic.startswith(topic_of(robot, ""))]
        return max(names, key=len, default=robot_of(topic))

    def turtlesims(self) -> set[str]:
        """Return the nodes that publish poses of turtles."""
        topics = [topic for topic, kind in self.types.items() if kind == POSE]
        return {node for topic in topics for node in self.publishers.get(topic, ())}

    def _robots_with(self, end: str, kind: str, column: Column) -> set[str]:
        topics = [topic for topic, nodes in column.items() if nodes and topic.endswith(end)]
        return {robot_of(topic) for topic in topics if self.types.get(topic) == kind}

    def reset_service(self, robot: str) -> str:
        """Return the service that resets this robot and no other. Raises RefusedError."""
        own, odometry = topic_of(robot, "reset"), topic_of(robot, "odom")
        if own in self.services and self.services[own] - self.turtlesims():
            return own
        for node in sorted(self.publishers.get(odometry, ())):
            its = [topic for topic, nodes in self.publishers.items() if node in nodes]
            is_alone = [topic for topic in its if topic.endswith("/odom")] == [odometry]
            if is_alone and f"{node}/reset" in self.services:
                return f"{node}/reset"
        raise RefusedError(f"no node has a service that resets {robot or 'the robot'}")

    def why_no_reset(self, robot: str) -> str:
        """Return why this robot cannot be reset, or ""."""
        try:
            self.reset_service(robot)
        except RefusedError as error:
            return str(error)
        return ""

    def parts(self) -> dict[str, Any]:
        """Return the graph as pages receive it, with connections as edges."""
        nodes, topics = sorted(self.nodes), sorted({*self.publishers, *self.subscribers})
        return {
            "nodes": [self._node(name) for name in nodes],
            "topics": [{"name": name, "type": self.types.get(name, "")} for name in topics],
            "services": sorted(self.services),
            "parameters": self.parameters,
            "edges": [edge for topic in topics for edge in self._edges(topic)],
        }

    def _node(self, name: str) -> dict[str, Any]:
        services = sorted(service for service, nodes in self.services.items() if name in nodes)
        return {"name": name, "machine": self.machines.get(name, ""), "services": services}

    def _edges(self, topic: str) -> Iterator[dict[str, str]]:
        this = f"topic {topic}"
        for node in sorted(self.publishers.get(topic, ())):
            yield {"from": f"node {node}", "to": this}
        for node in sorted(self.subscribers.get(topic, ())):
            yield {"from": this, "to": f"node {node}"}


class GraphWatcher(Protocol):
    """An object with the newest Graph."""

    graph: Graph


def topic_of(robot: str, name: str) -> str:
    """Return the name of a robot's topic; the robot "" has no namespace."""
    return f"/{robot}/{name}" if robot else f"/{name}"


def robot_of(topic: str) -> str:
    """Return the robot that a topic belongs to: its namespace."""
    return topic.rsplit("/", 1)[0].strip("/")


def graph_of(
    state: Any, types: dict[str, str], parameters: Iterable[str],
    machines: Mapping[str, str | None], own_name: str,
) -> Graph:  # fmt: skip
    """Return the Graph of the state that getSystemState() returns.

    machines: node -> its machine, or None if the node was killed.
    """
    dead = {node for node, machine in machines.items() if machine is None}
    shown = {topic for topic, _ in state[0]} - {"/rosout"}
    publishers = without({own_name}, without(dead, state[0]).items(), shown_in=shown)
    subscribers, services = [without({own_name, *dead}, column) for column in state[1:]]
    graph = Graph(publishers, subscribers, services, types, {}, sorted(parameters), own_name)
    graph.machines.update({node: machines.get(node) or "" for node in graph.nodes})
    return graph


def without(names: set[str], column: Iterable[Any], shown_in: Container[str] = ()) -> Column:
    """Return a column of getSystemState() as {entry: nodes}, without some nodes.

    shown_in: the entries in which these nodes stay.
    """
    users = {
        entry: frozenset(nodes) - (names if entry not in shown_in else set())
        for entry, nodes in column
    }
    return {entry: nodes for entry, nodes in users.items() if nodes}
