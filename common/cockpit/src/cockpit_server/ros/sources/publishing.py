"""Messages that a driver's page publishes from a form: once, or again and again with the protection
that driving has.

The page gives the beat: what it does not send, or sends late, is not published. After a silence
nothing more is published until a person begins. What moves a robot makes its page the driver, so
that the end of that session, by whatever loss, publishes what stops the robot.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import AbstractSet, Any, ClassVar, Mapping, Sequence

import rospy
from rosgraph.names import is_legal_name

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.driver_session import (
    LATE_S,
    SILENCE_S,
    Delay,
    Input,
    is_neutral,
    neutral_of,
)
from cockpit_server.driving.who_drives import Driving
from cockpit_server.graph import JOY
from cockpit_server.ros.feeds import later
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.ros.sources.forms import TEXTS, filled
from cockpit_server.schema import MILLISECONDS, full_name, number, or_null, switch, text, whole
from node_kit.message_types import message_class
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

SHORTEST_S, LONGEST_S = 0.02, 10.0  # between two messages
MOST_PUBLISHERS = 20
UNUSED_S = 5.0  # after which a publisher ends
CONNECT_S = 1.0  # A new publisher waits so long for its subscribers.
VELOCITY = "geometry_msgs/Twist"
SILENT = f"the page was silent for {SILENCE_S:g} s: publish again"


@dataclass
class Outlet:
    """A publisher that is kept for a while."""

    opened_at: float  # [s]
    used_at: float  # [s]
    waits: Any  # the newest message, while subscribers are connected
    publisher: Any = None  # once the master knows it

    def open(self, topic: str, kind: Any) -> None:
        self.publisher = PromptPublisher(topic, kind)

    def close(self) -> None:
        if self.publisher:
            self.publisher.end()

    def send(self, message: Any) -> None:
        if self.waits:
            self.waits = message
        else:
            self.publisher.publish(message)

    def send_first(self, wanted: AbstractSet[str], now: float) -> None:
        """Publish what waits, once these nodes are connected or CONNECT_S is over."""
        is_late = now - self.opened_at > CONNECT_S
        if self.waits and self.publisher and (is_late or wanted <= self.publisher.names):
            self.publisher.publish(self.waits)
            self.waits = None


@dataclass
class Held:
    """What a page publishes again and again, or a motion that it has started."""

    form: dict[str, Any]  # topic, type, values
    drives: bool  # The session of its page judges whether the operator is lost.
    fresh_at: float  # [s]
    delay: Delay = field(default_factory=Delay)


class Publishing(Source):
    """Publishes for pages that may drive, unless another page does; each holds one message."""

    messages: ClassVar = {
        "publish": {
            "topic": full_name, "type": text, "values": TEXTS,
            "period": or_null(number(SHORTEST_S, LONGEST_S)),
        },
        # A sign of life, with which the message is due or not.
        "again": {"n": whole, "t": MILLISECONDS, "beat": whole, "due": switch},
        "publish_end": {},
    }  # fmt: skip

    def __init__(self, driving: Driving, graph_watch: GraphWatch) -> None:
        self._driving, self._graphs = driving, graph_watch
        self._outlets: dict[tuple[str, str], Outlet] = {}  # by topic and type
        self._held: dict[int, Held] = {}  # by page

    def collect(self, clients: Sequence[Client], now: float) -> None:
        here = {client.number: client for client in clients}
        for page, held in list(self._held.items()):
            client = here.get(page)
            is_silent = not held.drives and now - held.fresh_at > SILENCE_S
            if is_silent and client:
                client.refuse("again", SILENT)
            if is_silent or not client or not self._is_on(client, held):
                del self._held[page]
        for key, outlet in list(self._outlets.items()):
            outlet.send_first(self._graphs.graph.subscribers.get(key[0], set()), now)
            if now - outlet.used_at > UNUSED_S:
                later(self._outlets.pop(key).close)

    def _is_on(self, client: Client, held: Held) -> bool:
        return not held.drives or self._driving.publishes(client, held.form["topic"])

    def on_publish(self, client: Client, now: float, *, period: float | None, **form: Any) -> None:
        message = self._message(client, **form)
        rest, topic = rest_of(message), form["topic"]
        drives = rest is not None and bool(period or moves(message))
        if period or rest is not None:
            self.on_publish_end(client, now)
        if drives:
            key = topic, message._type  # _send() below makes this outlet.
            rest_it = lambda: self._outlets[key].send(stamped(rest))  # noqa: E731  short
            self._driving.publish(client, topic, rest_it, now)
        self._send(topic, message, now)
        if period or drives:
            self._held[client.number] = Held(form, drives, now)

    def on_again(
        self, client: Client, now: float, *, n: int, t: float, beat: int, due: bool
    ) -> None:
        held = self._held.get(client.number)
        if held is None or not self._is_on(client, held):
            return  # It was under way when that ended.
        if held.drives:
            is_fresh = self._driving.session.sign(client.number, Input(n, t, beat, (), ()), now)
        else:
            is_fresh = held.delay.of(t, now) <= LATE_S
        if not is_fresh:
            return
        held.fresh_at = now
        try:
            message = self._message(client, **held.form)
        except RefusedError:
            self.on_publish_end(client, now)
            raise
        self._outlets[held.form["topic"], message._type].used_at = now
        if due:
            self._send(held.form["topic"], message, now)

    def on_publish_end(self, client: Client, _now: float) -> None:
        held = self._held.pop(client.number, None)
        if held and held.drives and self._is_on(client, held):
            self._driving.leave(client)

    def _message(self, client: Client, topic: str, type: str, values: Mapping[str, str]) -> Any:
        """Return a message that may be published. Raises RefusedError or ValueError."""
        self._driving.must_be_free(client)
        kind, known = message_class(type), self._graphs.graph.types.get(topic, type)
        if kind is None or known != type or not is_legal_name(topic):
            raise RefusedError(f"{topic}: no topic of the type {type}")
        if type == JOY and topic.endswith("/joy"):
            raise RefusedError("a joystick is moved in the tab Robot, where a loss stops the robot")
        if len(self._outlets) >= MOST_PUBLISHERS and (topic, type) not in self._outlets:
            raise RefusedError(f"at most {MOST_PUBLISHERS} topics in {UNUSED_S:g} s")
        return filled(kind, values)

    def _send(self, topic: str, message: Any, now: float) -> None:
        outlet = self._outlets.get((topic, message._type))
        if outlet:
            outlet.used_at = now
            outlet.send(message)
            return
        outlet = self._outlets[topic, message._type] = Outlet(now, now, message)
        later(outlet.open, topic, type(message))


def rest_of(message: Any) -> Any:
    """Return the message that ends a motion which one like this begins; None for other types."""
    rest = type(message)()
    if message._type == JOY:
        rest.axes, rest.buttons = neutral_of(message.axes, message.buttons)
    elif message._type != VELOCITY:
        return None
    return rest


def moves(message: Any) -> bool:
    if message._type == JOY:
        return not is_neutral(message.axes, message.buttons)
    return message != rest_of(message)


def stamped(message: Any) -> Any:
    """Return a message with the time, if it has a place for that."""
    if hasattr(message, "header"):
        message.header.stamp = rospy.Time.now()
    return message
