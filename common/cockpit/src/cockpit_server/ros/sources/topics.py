"""The topics that pages look at: how often messages come, and the newest as text."""

from __future__ import annotations

import math
import time
from collections import deque
from typing import Any, ClassVar, Sequence

from cockpit_server.clients import Client, Source
from cockpit_server.ros.feeds import Feeds
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.schema import full_name, list_of, or_null
from node_kit.message_types import message_class

PERIOD_S = 0.25  # between two looks
LONGEST_TEXT = 4000  # characters of a message
LONGEST_MESSAGE = 20_000  # bytes; the text of a longer one would hold up the driver
WINDOW_S = 5.0  # over which the rate is counted
SILENT_S, SILENT_PERIODS = 2.0, 3.0  # without a message, of the mean period: the rate is 0
MOST_RATES = 40  # topics, as many as a page has in sight
MOST_TOPICS = 100  # are measured, for all pages together
ECHOED = 3  # messages that are written in a look; others are only counted


class Topic:
    """The messages of one topic."""

    def __init__(self) -> None:
        self.is_echoed = False
        self.echo: list[tuple[int, str]] = []  # number and text of the newest
        self.rate = self.bytes_per_s = 0.0
        self._last = (0.0, 0, 0)  # when the newest came [s], how many came, of how many bytes
        self._marks: deque[tuple[float, int, int]] = deque()  # as _last was, at each look
        self._newest: deque[tuple[int, bytes]] = deque(maxlen=ECHOED)

    def hear(self, message: Any, _topic: str) -> None:
        _, count, size = self._last
        self._last = (time.monotonic(), count + 1, size + len(message.data))
        if self.is_echoed:
            self._newest.append((count + 1, message.data))

    def look(self, type_name: str, now: float) -> None:
        """Write what has come, and set the rate [Hz] and bytes per second from the times at which
        messages came; call about once in PERIOD_S.
        """
        newest, self._newest = self._newest, deque(maxlen=ECHOED)
        self.echo += [(number, text(data, type_name)) for number, data in newest]
        del self.echo[:-ECHOED]
        last, marks = self._last, self._marks
        if last[1] and (not marks or marks[-1] != last):
            marks.append(last)
        while len(marks) > 2 and marks[1][0] <= now - WINDOW_S:
            marks.popleft()
        self.rate = self.bytes_per_s = 0.0
        if len(marks) < 2:
            return
        duration, count, size = (new - old for new, old in zip(marks[-1], marks[0]))
        if now - last[0] > max(SILENT_S, SILENT_PERIODS * duration / count):
            marks.clear()
        elif duration > 0:
            self.rate, self.bytes_per_s = count / duration, size / duration


def text(data: bytes, type_name: str) -> str:
    """Return a message as text."""
    kind = message_class(type_name)
    if kind is None:
        return f"({len(data)} bytes; the package of {type_name} is not installed here)"
    if len(data) > LONGEST_MESSAGE:
        return f"({len(data)} bytes)"
    try:
        shown = str(kind().deserialize(data))
    except Exception as error:  # whatever the bytes made a message class do
        return f"(cannot be read: {error})"
    return shown if len(shown) <= LONGEST_TEXT else f"{shown[:LONGEST_TEXT]}\n..."


class Topics(Source):
    """Sends the rates of the topics that a page has in sight, and messages of the chosen one."""

    watches: ClassVar = {
        "topic": (or_null(full_name), None),
        "rates": (list_of(full_name, MOST_RATES), ()),
    }

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._topics: dict[str, Topic] = {}
        self._looked_at = -math.inf  # [s]

    def collect(self, clients: Sequence[Client], now: float) -> None:
        shown = {client.watch.topic for client in clients} - {None}
        rates = {name for client in clients for name in client.watch.rates}
        names = [*sorted(shown), *sorted(rates - shown)][:MOST_TOPICS]
        self._topics = {name: self._topics.get(name) or Topic() for name in names}
        types = self._graphs.graph.types
        there = {name: one.hear for name, one in self._topics.items() if name in types}
        self._feeds.set_subscriptions(self, there, every=True)
        is_due = now - self._looked_at >= PERIOD_S
        self._looked_at = now if is_due else self._looked_at
        for name, topic in self._topics.items():
            topic.is_echoed = name in shown
            if is_due:
                topic.look(types.get(name, ""), now)

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.rates and client.take_if_new("rates", self._looked_at):
            topics = {n: self._topics[n] for n in client.watch.rates if n in self._topics}
            rates = {n: [round(t.rate, 2), round(t.bytes_per_s)] for n, t in topics.items()}
            client.send("rates", rates=rates)
        name = client.watch.topic
        topic = self._topics.get(name)
        seen, last = client.seen.get("echo", (name, 0))
        last = last if seen == name else 0
        echo = [one for one in topic.echo if one[0] > last] if topic else []
        client.seen["echo"] = (name, echo[-1][0] if echo else last)
        if echo:
            client.send("topic", name=name, echo=echo)
