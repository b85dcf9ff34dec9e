"""Messages that a driver's page publishes from a form: once, or again and again with the protection
that driving has.

The page gives the beat: what it does not send, or sends late, is not published. After a silence
there is a zero velocity, where velocities were published, and nothing more until a person begins.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import AbstractSet, Any, ClassVar, Mapping, Sequence

from rosgraph.names import is_legal_name

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.driver_session import LATE_S, SILENCE_S, Delay
from cockpit_server.driving.who_drives import Driving
from cockpit_server.feeds import later
from cockpit_server.graph import JOY
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import MILLISECONDS, full_name, number, or_null, text
from cockpit_server.sources.forms import TEXTS, filled
from node_kit.message_types import message_class
from node_kit.rospy_patches.prompt_publisher import PromptPublisher

SHORTEST_S, LONGEST_S = 0.02, 10.0  # between two messages
MOST_PUBLISHERS = 20
UNUSED_S = 5.0  # after which a publisher ends
CONNECT_S = 1.0  # A new publisher waits so long for its subscribers.
VELOCITY = "geometry_msgs/Twist"


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

    def send(self, message: Any, now: float) -> None:
        self.used_at = now
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
class Repeat:
    """What a page publishes again and again."""

    form: dict[str, Any]  # topic, type, values
    period: float  # [s]
    fresh_at: float  # [s]
    delay: Delay = field(default_factory=Delay)


class Publishing(Source):
    """Publishes for pages that may drive, unless another page does; each repeats one message."""

    messages: ClassVar = {
        "publish": {
            "topic": full_name, "type": text, "values": TEXTS,
            "period": or_null(number(SHORTEST_S, LONGEST_S)),
        },
        "again": {"t": MILLISECONDS},
        "publish_end": {},
    }  # fmt: skip

    def __init__(self, driving: Driving, graph_watch: GraphWatch) -> None:
        self._driving, self._graphs = driving, graph_watch
        self._outlets: dict[tuple[str, str], Outlet] = {}  # by topic and type
        self._repeats: dict[int, Repeat] = {}  # by page

    def collect(self, clients: Sequence[Client], now: float) -> None:
        here = {client.number for client in clients}
        for page, one in list(self._repeats.items()):
            if page not in here or now - one.fresh_at > one.period + SILENCE_S:
                self._end(page, now)
        for key, outlet in list(self._outlets.items()):
            outlet.send_first(self._graphs.graph.subscribers.get(key[0], set()), now)
            if now - outlet.used_at > UNUSED_S:
                later(self._outlets.pop(key).close)

    def on_publish(self, client: Client, now: float, *, period: float | None, **form: Any) -> None:
        self._end(client.number, now)
        self._publish(client, now, **form)
        if period:
            self._repeats[client.number] = Repeat(form, period, now)

    def on_again(self, client: Client, now: float, t: float) -> None:
        one = self._repeats.get(client.number)
        if one is None:
            raise RefusedError("the page was silent for too long: publish again")
        if one.delay.of(t, now) > LATE_S:
            return
        one.fresh_at = now
        try:
            self._publish(client, now, **one.form)
        except RefusedError:
            self._end(client.number, now)
            raise

    def on_publish_end(self, client: Client, now: float) -> None:
        self._end(client.number, now)

    def _publish(
        self, client: Client, now: float, topic: str, type: str, values: Mapping[str, str]
    ) -> None:
        self._driving.must_be_free(client)
        kind, known = message_class(type), self._graphs.graph.types.get(topic, type)
        if kind is None or known != type or not is_legal_name(topic):
            raise RefusedError(f"{topic}: no topic of the type {type}")
        if type == JOY and topic.endswith("/joy"):
            raise RefusedError("a joystick is moved in the tab Robot, where a loss stops the robot")
        message, outlet = filled(kind, values), self._outlets.get((topic, type))
        if outlet is None:
            if len(self._outlets) >= MOST_PUBLISHERS:
                raise RefusedError(f"at most {MOST_PUBLISHERS} topics in {UNUSED_S:g} s")
            outlet = self._outlets[topic, type] = Outlet(now, now, message)
            later(outlet.open, topic, kind)
        outlet.send(message, now)

    def _end(self, page: int, now: float) -> None:
        """End what a page repeats, with a zero velocity where velocities were published."""
        one = self._repeats.pop(page, None)
        outlet = one and self._outlets.get((one.form["topic"], VELOCITY))
        if outlet:
            outlet.send(message_class(VELOCITY)(), now)
