"""The channels: one for each topic, which is subscribed while a client subscribes to it."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Container, Mapping

import rospy
from foxglove import Channel, Context, Schema

from node_kit.message_types import message_class
from node_kit.ros.graph.raw_messages import RawMessage, senders, subscribe
from node_kit.ros.rospy_patches.connections import established

ENCODING, SCHEMAS = "ros1", "ros1msg"
DEPTH = 10_000  # messages that may arrive while one is passed on
DEFINITION_S = 1.0  # for a publisher to send the definition of its type


class _Feed:
    """The channel of a topic, and the newest message of each latched publisher."""

    def __init__(self, topic: str, kind: str, definition: str, context: Context) -> None:
        self.topic, self.kind = topic, kind
        schema = Schema(name=kind, encoding=SCHEMAS, data=definition.encode())
        self.channel = Channel(topic, message_encoding=ENCODING, schema=schema, context=context)
        self._lock = threading.Lock()  # each publisher has a thread
        self._latched: dict[str, bytes] = {}  # by the name of the publisher
        self._subscriber: rospy.Subscriber | None = None

    def send_to(self, client: int) -> None:
        """Subscribe for a client. A later one gets latched messages here: ROS sends them once."""
        if self._subscriber is None:
            self._subscriber = subscribe(self.topic, self._receive, DEPTH)
            return
        connected = senders(self._subscriber)
        with self._lock:
            for sender in connected & set(self._latched):
                self.log(self._latched[sender], client)

    def rest(self) -> None:
        """Unsubscribe, if no client is left."""
        if self._subscriber and not self.channel.has_sinks():
            self._subscriber.unregister()
            self._subscriber = None
            self._latched.clear()

    def log(self, data: bytes, client: int | None = None) -> None:
        self.channel.log(data, log_time=rospy.get_rostime().to_nsec(), sink_id=client)

    def _receive(self, message: RawMessage) -> None:
        with self._lock:
            if message.is_latched:
                self._latched[message.sender] = message.data
            self.log(message.data)


class TopicChannels:
    """The channels of all topics; clock: the only topic that the node itself subscribes.

    One thread changes them and calls the master, which may block.
    """

    def __init__(self, context: Context, clock: str) -> None:
        self._context, self._clock = context, clock
        self._feeds: dict[str, _Feed] = {}
        self._worker = ThreadPoolExecutor(1)

    def show(self, kinds: Mapping[str, str], published: Container[str]) -> None:
        """Advertise exactly these topics; kinds: {topic: package/Name}."""
        for topic, feed in list(self._feeds.items()):
            if kinds.get(topic) != feed.kind:
                self._worker.submit(self._remove, topic)
        for topic in sorted(set(kinds) - set(self._feeds)):
            definition = _definition(topic, kinds[topic], topic in published)
            if definition is not None:
                self._worker.submit(self._add, topic, kinds[topic], definition)

    def pass_on_clock(self, data: bytes) -> None:
        feed = self._feeds.get(self._clock)
        if feed:
            feed.log(data)

    def on_subscribe(self, client: Any, channel: Any) -> None:
        if channel.topic != self._clock:
            self._worker.submit(self._change, channel.topic, _Feed.send_to, client.id)

    def on_unsubscribe(self, _client: Any, channel: Any) -> None:
        self._worker.submit(self._change, channel.topic, _Feed.rest)

    def _change(self, topic: str, change: Callable[..., None], *arguments: int) -> None:
        if topic in self._feeds:
            change(self._feeds[topic], *arguments)

    def _add(self, topic: str, kind: str, definition: str) -> None:
        if topic not in self._feeds:
            self._feeds[topic] = _Feed(topic, kind, definition, self._context)

    def _remove(self, topic: str) -> None:
        feed = self._feeds.pop(topic, None)
        if feed:
            feed.channel.close()
            feed.rest()


def _definition(topic: str, kind: str, is_published: bool) -> str | None:
    """Return the definition of a type, from a publisher if it is not installed here."""
    known = message_class(kind)
    if known or not is_published:
        return str(known._full_text) if known else None
    subscriber, deadline = rospy.Subscriber(topic, rospy.AnyMsg), time.monotonic() + DEFINITION_S
    try:
        while time.monotonic() < deadline:
            for link in established(subscriber):
                return link.header.get("message_definition")
            time.sleep(0.02)
    finally:
        subscriber.unregister()
    return None
