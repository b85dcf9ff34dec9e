"""What clients publish: sent in one thread, and a motion is ended by a zero."""

from __future__ import annotations

import queue
import struct
import threading
import time
from typing import Any, Callable, Iterable, Pattern, Tuple

import rospy
from rosgraph.names import is_legal_name

from foxglove_bridge_server.parameters import is_allowed
from foxglove_bridge_server.ros.topic_channels import ENCODING
from foxglove_bridge_server.velocities import KINDS, VelocityTopic
from node_kit.message_types import message_class
from node_kit.ros.graph.raw_messages import RawMessage, subscribe
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

TICK_S = 0.1
DELIVERY_S = 0.1  # for a zero to arrive before its connection is closed
LONGEST_END_S = 0.5
LONGEST_QUEUE = 1000  # messages of clients; later ones are lost
User = Tuple[int, int]  # a client, and its number for the topic


class _Outlet:
    """A topic on which clients publish."""

    def __init__(self, topic: str, kind: Any) -> None:
        self.topic, self.kind = topic, kind
        self.users: set[User] = set()
        self._publisher = PromptPublisher(topic, kind)
        self.velocity = VelocityTopic() if kind._type in KINDS else None
        self._others = subscribe(topic, self._hear, 10) if self.velocity else None

    def _hear(self, message: RawMessage) -> None:
        if self.velocity and message.sender != rospy.get_name():
            self.velocity.hear(message.sender, time.monotonic())

    def refusal(self, user: User, data: bytes) -> str:
        """Return why a message is not published, or ""."""
        try:
            self.kind().deserialize(data)
        except Exception:  # malformed bytes may raise anything
            return f"not a {self.kind._type}"
        return self.velocity.refusal(user, time.monotonic()) if self.velocity else ""

    def send(self, user: User, data: bytes) -> None:
        self._publisher.send(struct.pack("<I", len(data)) + data)
        if self.velocity:
            self.velocity.command(user, data, time.monotonic())

    def leave(self, user: User) -> None:
        self.users.discard(user)
        if self.velocity and self.velocity.end(user):
            self._send_zero()

    def expire(self) -> None:
        if self.velocity and self.velocity.expire(time.monotonic()):
            self._send_zero()

    def _send_zero(self) -> None:
        zero = self.kind()
        if hasattr(zero, "header"):
            zero.header.stamp = rospy.Time.now()
        self._publisher.publish(zero)

    def close(self) -> None:
        if self._others:
            self._others.unregister()
        threading.Timer(DELIVERY_S, self._publisher.end).start()


class ClientTopics:
    """The topics on which clients publish. The SDK's threads only queue what clients send."""

    def __init__(self, whitelist: Iterable[Pattern[str]], warn: Callable[[str], object]) -> None:
        self._whitelist, self._warn = whitelist, warn
        self._jobs: queue.SimpleQueue[tuple[Any, ...]] = queue.SimpleQueue()
        self._outlets: dict[str, _Outlet] = {}
        self._users: dict[User, _Outlet] = {}
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
            for outlet in self._outlets.values():
                outlet.expire()

    def end(self) -> None:
        """End all motions, and wait until the zeros have arrived."""
        self._jobs.put((self._close_all,))
        if self._has_ended.wait(LONGEST_END_S):
            threading.Event().wait(DELIVERY_S)

    def _close_all(self) -> None:
        for user in list(self._users):
            self._close(user)
        self._has_ended.set()

    def _open(self, user: User, topic: str, kind_name: str, encoding: str) -> None:
        kind = message_class(kind_name)
        refusal = ""
        if encoding != ENCODING:
            refusal = f"the encoding must be {ENCODING}, not {encoding}"
        elif not is_legal_name(topic) or not is_allowed(topic, self._whitelist):
            refusal = "client_topic_whitelist does not have it"
        elif kind is None:
            refusal = f"{kind_name} is not installed here"
        elif topic in self._outlets and self._outlets[topic].kind is not kind:
            refusal = f"another client publishes {self._outlets[topic].kind._type} there"
        if refusal:
            self._warn(f"{topic} cannot be published: {refusal}")
            return
        outlet = self._outlets.get(topic) or _Outlet(topic, kind)
        self._outlets[topic] = self._users[user] = outlet
        outlet.users.add(user)

    def _send(self, user: User, data: bytes) -> None:
        outlet = self._users.get(user)
        if outlet is None:
            return
        refusal = outlet.refusal(user, data)
        if not refusal:
            outlet.send(user, data)
        elif refusal != self._refusals.get(user):
            self._warn(f"{outlet.topic}: a message is refused: {refusal}")
        self._refusals[user] = refusal

    def _close(self, user: User) -> None:
        self._refusals.pop(user, None)
        outlet = self._users.pop(user, None)
        if outlet is None:
            return
        outlet.leave(user)
        if not outlet.users:
            self._outlets.pop(outlet.topic).close()
