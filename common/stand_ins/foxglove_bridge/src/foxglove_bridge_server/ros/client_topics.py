"""What clients publish: sent in one thread, and a motion is ended by a zero."""

from __future__ import annotations

import queue
import struct
import threading
import time
from typing import Any, Callable, Tuple

import rospy
from rosgraph.names import is_legal_name

from foxglove_bridge_server.messages import fits
from foxglove_bridge_server.parameters import Patterns, is_allowed
from foxglove_bridge_server.ros.master import kind_of_others
from foxglove_bridge_server.ros.topic_channels import ENCODING
from foxglove_bridge_server.velocities import KINDS, VelocityTopic
from node_kit.message_types import message_class
from node_kit.ros.graph.raw_messages import RawMessage, subscribe
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

TICK_S = 0.1
DELIVERY_S = 0.1  # for a zero to arrive before its connection is closed
KEPT_S = 1.0  # for a topic without a client: a panel that is drawn again advertises it again
LONGEST_END_S = 0.5
LONGEST_QUEUE = 1000  # messages of clients; later ones are lost
User = Tuple[int, int]  # a client, and its number for the topic


class _Outlet:
    """A topic on which clients publish. Only that of a velocity is watched, and gets zeros."""

    def __init__(self, topic: str, kind: Any) -> None:
        self.topic, self.kind = topic, kind
        self._publisher, self._velocity = PromptPublisher(topic, kind), VelocityTopic()
        self._others = subscribe(topic, self._hear, 10) if kind._type in KINDS else None

    def _hear(self, message: RawMessage) -> None:
        if message.sender != rospy.get_name():
            self._velocity.hear(message.sender, time.monotonic())

    def send(self, user: User, data: bytes) -> str:
        """Publish a message, or return why not."""
        if not fits(data, self.kind):
            return f"not a {self.kind._type}"
        now = time.monotonic()
        refusal = self._velocity.refusal(user, now)
        if not refusal:
            self._publisher.send(struct.pack("<I", len(data)) + data)
            if self._others:
                self._velocity.command(user, data, now)
        return refusal

    def end_motion(self, gone: User | None = None) -> None:
        """Publish a zero, if one is due."""
        if self._velocity.is_zero_due(time.monotonic(), gone):
            zero = self.kind()
            if hasattr(zero, "header"):
                zero.header.stamp = rospy.get_rostime()
            self._publisher.publish(zero)

    def close(self) -> None:
        if self._others:
            self._others.unregister()
        self._publisher.end()


class ClientTopics:
    """The topics on which clients publish. The SDK's threads only queue what clients send."""

    def __init__(self, whitelist: Patterns, warn: Callable[[str], object]) -> None:
        self._whitelist, self._warn = whitelist, warn
        self._jobs: queue.SimpleQueue[tuple[Any, ...]] = queue.SimpleQueue()
        self._outlets: dict[User, _Outlet] = {}
        self._kept: dict[str, tuple[_Outlet, float]] = {}  # by topic, until when
        self._kinds: dict[str, str] = {}  # the last type of each topic
        self._refusals: dict[User, str] = {}
        self._has_ended = threading.Event()

    def on_client_advertise(self, client: Any, channel: Any) -> None:
        about = channel.topic, channel.schema_name, channel.encoding
        self._jobs.put((self._open, (client.id, channel.id), *about))

    def on_client_unadvertise(self, client: Any, number: int) -> None:
        self._jobs.put((self._close, (client.id, number)))

    def on_message_data(self, client: Any, number: int, data: bytes) -> None:
        if self._jobs.qsize() < LONGEST_QUEUE:
            self._jobs.put((self._send, (client.id, number), data))

    def run(self) -> None:
        """Do what clients send, until end() is called."""
        while not self._has_ended.is_set():
            try:
                job, *arguments = self._jobs.get(timeout=TICK_S)
                job(*arguments)
            except queue.Empty:
                pass
            for outlet in set(self._outlets.values()):
                outlet.end_motion()
            for topic, (outlet, until) in list(self._kept.items()):
                if time.monotonic() > until:
                    del self._kept[topic]
                    outlet.close()

    def end(self) -> None:
        """End all motions, and wait until the zeros have arrived."""
        self._jobs.put((self._close_all,))
        if self._has_ended.wait(LONGEST_END_S):
            threading.Event().wait(DELIVERY_S)

    def _close_all(self) -> None:
        for user, outlet in self._outlets.items():
            outlet.end_motion(user)
        self._has_ended.set()

    def _open(self, user: User, topic: str, kind_name: str, encoding: str) -> None:
        is_legal = bool(topic) and is_legal_name(topic)
        topic = rospy.resolve_name(topic) if is_legal else topic
        kind = message_class(kind_name)
        known = {outlet.topic: outlet for outlet in self._outlets.values()}.get(topic)
        of_master = kind_of_others(topic, self._kinds.get(topic, ""))
        refusal = ""
        if encoding != ENCODING:
            refusal = f"the encoding must be {ENCODING}, not {encoding!r}"
        elif not is_legal or not is_allowed(topic, self._whitelist):
            refusal = "client_topic_whitelist does not have it"
        elif kind is None:
            refusal = f"{kind_name!r} is not installed here"
        elif known and known.kind is not kind:
            refusal = f"another client publishes {known.kind._type} there"
        elif of_master not in ("", kind_name):
            refusal = f"the master has {of_master} there, not {kind_name}"
        if refusal:
            self._warn(f"{topic!r} cannot be published: {refusal}")
            return
        kept, _ = self._kept.pop(topic, (None, 0.0))
        if kept and kept.kind is not kind:  # rospy has one type for each topic
            kept.close()
            kept = None
        self._outlets[user] = known or kept or _Outlet(topic, kind)
        self._kinds[topic] = kind_name

    def _send(self, user: User, data: bytes) -> None:
        if user in self._outlets:
            refusal = self._outlets[user].send(user, data)
            if refusal and refusal != self._refusals.get(user):
                self._warn(f"{self._outlets[user].topic}: a message is refused: {refusal}")
            self._refusals[user] = refusal

    def _close(self, user: User) -> None:
        self._refusals.pop(user, None)
        outlet = self._outlets.pop(user, None)
        if outlet:
            outlet.end_motion(user)
            if outlet not in self._outlets.values():
                self._kept[outlet.topic] = outlet, time.monotonic() + KEPT_S
