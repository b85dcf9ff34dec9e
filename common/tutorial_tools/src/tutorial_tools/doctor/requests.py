"""Which messages the doctor needs, and from which nodes."""

from __future__ import annotations

from typing import NamedTuple

from tutorial_tools.doctor.facts import JOY, Facts
from tutorial_tools.doctor.transforms import TOPICS as TRANSFORM_TOPICS

# Frequent messages that begin with a Header: sequence number, stamp as two uint32 (s, ns).
STAMPED = (
    "diagnostic_msgs/DiagnosticArray", "nav_msgs/Odometry", "sensor_msgs/JointState", JOY,
    "sensor_msgs/LaserScan",
)  # fmt: skip
STAMPED_TOPICS = 6  # per host
STAMPED_MESSAGES = 20  # per topic; the fastest one counts
BRIDGE = "/ros2_bridge"  # the node of ros2_bridge
DIAGNOSTICS, CLOCK = "/diagnostics", "/clock"


class TopicRequest(NamedTuple):
    """The messages that are needed from a node."""

    node: str
    topic: str
    most: int = 1  # messages


def of_graph(facts: Facts) -> list[TopicRequest]:
    """Return all requests to the nodes that answer."""
    needed = [request for host in for_clocks(facts).values() for request in host]
    needed += [TopicRequest(name, DIAGNOSTICS) for name in reporters(facts)]
    for topic in (*active_topics(facts), CLOCK):
        needed += [TopicRequest(name, topic) for name in facts.publishers.get(topic, [])[:1]]
    for topic in TRANSFORM_TOPICS:
        needed += [TopicRequest(name, topic, STAMPED_MESSAGES) for name in facts.senders(topic)]
    return [request for request in needed if facts.answers(request.node)]


def for_clocks(facts: Facts) -> dict[str, list[TopicRequest]]:
    """Return by host the requests that show its clock; only for other machines."""
    stamped = [topic for kind in STAMPED for topic in facts.topics(kind)]
    needed: dict[str, list[TopicRequest]] = {}
    for name, node in facts.nodes.items():
        if facts.answers(name) and node.here is False:
            sent = [topic for topic in stamped if name in facts.publishers.get(topic, [])]
            host = needed.setdefault(node.host, [])
            host += [TopicRequest(name, topic, STAMPED_MESSAGES) for topic in sent]
    return {host: of_host[:STAMPED_TOPICS] for host, of_host in needed.items()}


def reporters(facts: Facts) -> set[str]:
    """Return the nodes whose diagnostics are needed."""
    bridge = {BRIDGE} if facts.answers(BRIDGE) else set()
    return {*facts.converters(), *joystick_nodes(facts), *kobuki_nodes(facts), *bridge}


def joystick_nodes(facts: Facts) -> set[str]:
    """Return the nodes that publish joysticks."""
    names = {name for joy in facts.topics(JOY) for name in facts.publishers.get(joy, [])}
    return names & set(facts.nodes)


def kobuki_nodes(facts: Facts) -> set[str]:
    """Return the nodes that publish the sensors of a Kobuki."""
    topics = facts.topics("kobuki_msgs/SensorState")
    return {name for topic in topics for name in facts.senders(topic)}


def active_topics(facts: Facts) -> list[str]:
    """Return the topics on which multiplexers publish their active input."""
    return [topic for topic in facts.topics("std_msgs/String") if topic.endswith("/active")]
