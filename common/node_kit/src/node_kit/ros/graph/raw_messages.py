"""Subscribes and publishes messages of any type as bytes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

import rosgraph
import rospy

from node_kit.message_types import message_class
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer


@dataclass(frozen=True)
class RawMessage:
    """A received message. type: package/Name. sender: the name of its node."""

    data: bytes
    type: str
    sender: str
    is_latched: bool
    is_first: bool  # the first message of a latched connection may be old


def subscribe(topic: str, callback: Callable[[RawMessage], object], depth: int) -> rospy.Subscriber:
    """Call callback with each message of a topic. depth: the queue size."""

    def hear(message: Any) -> None:
        about = message._connection_header
        is_latched, is_first = about.get("latching") == "1", hear not in about
        about[hear] = "heard"  # each connection has its own header
        sender = about.get("callerid", "")
        callback(RawMessage(message._buff, about["type"], sender, is_latched, is_first))

    options = {"queue_size": depth, "tcp_nodelay": True, "buff_size": 1 << 22}
    return rospy.Subscriber(topic, rospy.AnyMsg, hear, **options)


def senders(subscriber: rospy.Subscriber) -> set[str]:
    """Return the names of the nodes that a subscriber is connected to."""
    connections = getattr(subscriber.impl, "connections", ())  # none at the end
    return {link.callerid_pub for link in list(connections) if link.socket}


class RawPublisher:
    """Publishes bytes as messages of a type that is given by its name."""

    def __init__(self, topic: str, kind: str, depth: int, is_latched: bool) -> None:
        """Take the type as package/Name. Raises LookupError if this machine lacks it.

        is_latched: the value in the connections' headers until the first message.
        """
        known = message_class(kind)
        if known is None:
            raise LookupError(f"{kind}: ROS 1 has no such type here")
        names = ("_type", "_md5sum", "_full_text")
        about = {name: getattr(known, name) for name in names}
        self._class = type("Raw", (rospy.AnyMsg,), about)
        self._publisher = rospy.Publisher(
            topic, self._class, queue_size=depth, latch=is_latched, tcp_nodelay=True
        )

    def publish(self, data: bytes, is_latched: bool) -> None:
        """Send the bytes of a message. is_latched: keep it for late subscribers, until the next."""
        message = self._class()
        message._buff = data
        # A new rospy.Publisher would lose subscribers: one that has not yet closed the old
        # connection assumes that it is connected to this node, and does not connect again.
        impl = self._publisher.impl
        impl.latch = message  # before is_latch: another thread of rospy reads both
        impl.is_latch = is_latched
        self._publisher.publish(message)

    def end(self) -> None:
        """Close all connections and unregister."""
        self._publisher.unregister()


def types_of_others() -> list[tuple[str, str]]:
    """Return (topic, package/Name) of each topic that other nodes publish, if a master answers."""
    master = rosgraph.get_master_uri()
    answer, state = call(master, "getSystemState")
    known, types = call(master, "getTopicTypes")
    if answer is not Answer.WELL or known is not Answer.WELL:
        return []
    own = rospy.get_name()
    topics = {topic for topic, nodes in state[0] if set(nodes) - {own}}
    return [(topic, kind) for topic, kind in types if topic in topics and kind != "*"]
