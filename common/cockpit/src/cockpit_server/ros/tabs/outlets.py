"""The publishers of the messages that pages write in forms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import AbstractSet, Any, Mapping

import rospy
from rosgraph.names import is_legal_name

from cockpit_server.errors import RefusedError
from cockpit_server.graph import Column
from cockpit_server.ros.feeds import later
from cockpit_server.ros.tabs.forms import filled
from cockpit_server.tabs.publishing import no_topic
from node_kit.message_types import message_class
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

MOST_PUBLISHERS = 20
UNUSED_S = 5.0  # after which a publisher is closed
CONNECT_S = 1.0  # how long a new publisher waits for its subscribers


@dataclass
class Outlet:
    """A publisher that is kept for a while."""

    opened_at: float  # [s]
    used_at: float  # [s]
    waiting: Any  # the newest message, until subscribers are connected
    publisher: Any = None  # once it is registered with the master

    def open(self, topic: str, kind: Any) -> None:
        self.publisher = PromptPublisher(topic, kind)

    def close(self) -> None:
        if self.publisher:
            self.publisher.end()

    def send(self, message: Any) -> None:
        if self.waiting:
            self.waiting = message
        else:
            self.publisher.publish(message)

    def send_first(self, wanted: AbstractSet[str], now: float) -> None:
        """Publish what is waiting, once these nodes are connected or CONNECT_S has passed."""
        is_late = now - self.opened_at > CONNECT_S
        if self.waiting and self.publisher and (is_late or wanted <= self.publisher.names):
            self.publisher.publish(self.waiting)
            self.waiting = None


class Outlets:
    """The publishers that were used in the last UNUSED_S."""

    def __init__(self) -> None:
        self._outlets: dict[tuple[str, str], Outlet] = {}  # by topic and type

    def message(self, topic: str, type_name: str, values: Mapping[str, str], i: int) -> Any:
        """Return a message of a form. i: its number. Raises RefusedError or ValueError."""
        kind = message_class(type_name)
        if kind is None or not is_legal_name(topic):
            raise no_topic(topic, type_name)
        if len(self._outlets) >= MOST_PUBLISHERS and (topic, type_name) not in self._outlets:
            raise RefusedError(f"at most {MOST_PUBLISHERS} topics in {UNUSED_S:g} s")
        return filled(kind, values, i)

    def send(self, topic: str, message: Any, now: float) -> None:
        """Publish a message, by a new publisher if needed."""
        outlet = self._outlets.get((topic, message._type))
        if outlet:
            outlet.used_at = now
            outlet.send(message)
            return
        outlet = self._outlets[topic, message._type] = Outlet(now, now, message)
        later(outlet.open, topic, type(message))

    def keep(self, topic: str, type_name: str, now: float) -> None:
        """Keep the publisher of a form open until its next message."""
        self._outlets[topic, type_name].used_at = now

    def send_rest(self, topic: str, message: Any) -> None:
        """Publish the message that ends a motion, with the time, by the same publisher."""
        if hasattr(message, "header"):
            message.header.stamp = rospy.Time.now()
        self._outlets[topic, message._type].send(message)

    def collect(self, subscribers: Column, now: float) -> None:
        """Publish what has waited for subscribers, and close what is unused."""
        for key, outlet in list(self._outlets.items()):
            outlet.send_first(subscribers.get(key[0], frozenset()), now)
            if now - outlet.used_at > UNUSED_S:
                later(self._outlets.pop(key).close)
