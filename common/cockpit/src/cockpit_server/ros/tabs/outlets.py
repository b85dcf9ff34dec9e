"""The publishers of the messages that pages write in forms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import AbstractSet, Any, Mapping, Protocol

import rospy
from rosgraph.names import is_legal_name

from cockpit_server.errors import RefusedError
from cockpit_server.graph import Column
from cockpit_server.ros.feeds import later
from cockpit_server.ros.tabs.forms import filled
from cockpit_server.tabs.publishing import no_topic, rest_of
from node_kit.message_types import message_class
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

MOST_PUBLISHERS = 20
UNUSED_S = 5.0  # after which a publisher is closed
CONNECT_S = 1.0  # how long a motion waits for the subscribers of its new publisher
MEET_S = 1.5  # how long another message waits for them, after registration


class Looks(Protocol):
    """What looks at the graph: see GraphWatch."""

    looked_at: float  # [s] when the newest look began

    def look_soon(self) -> None: ...


@dataclass
class Outlet:
    """A publisher that is kept for a while."""

    opened_at: float  # [s]
    used_at: float  # [s]
    waiting: Any  # the newest message, until subscribers are connected
    publisher: Any = None  # once it is registered with the master
    registered_at: float | None = None  # [s] when that was noticed

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

    def send_first(self, wanted: AbstractSet[str], looked_at: float, now: float) -> None:
        """Publish what is waiting, if it is late or its subscribers are connected.

        wanted: their names. looked_at: when they were read from the graph. A motion does not wait
        for that, nor for a node such as rostopic, which subscribes once there is a publisher.
        """
        if not self.waiting or self.registered_at is None:
            return
        if rest_of(self.waiting) is not None:
            is_due = now - self.opened_at > CONNECT_S or wanted <= self.publisher.names
        else:
            is_new = looked_at > self.registered_at and bool(wanted)
            is_connected = is_new and wanted <= self.publisher.names
            is_due = is_connected or now - self.registered_at > MEET_S
        if is_due:
            self.publisher.publish(self.waiting)
            self.waiting = None


class Outlets:
    """The publishers that were used in the last UNUSED_S."""

    def __init__(self, looks: Looks) -> None:
        self._looks = looks
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
            if outlet.publisher and outlet.registered_at is None:
                outlet.registered_at = now
                self._looks.look_soon()
            outlet.send_first(subscribers.get(key[0], frozenset()), self._looks.looked_at, now)
            if now - outlet.used_at > UNUSED_S:
                later(self._outlets.pop(key).close)
