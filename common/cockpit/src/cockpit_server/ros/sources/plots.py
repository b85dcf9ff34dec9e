"""Curves of numbers in messages, every one of them, for the pages that draw them."""

from __future__ import annotations

import threading
from collections import deque
from itertools import takewhile
from typing import Any, ClassVar, Sequence, Tuple

import rospy

from cockpit_server.clients import Client, Source
from cockpit_server.fields import numbers_of, parts_of, split, value_at
from cockpit_server.ros.feeds import Feeds, read
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.schema import MOST_FIELDS, list_of, switch, text
from node_kit.message_types import message_class

NEAR_S = 1.0  # between a stamp and this clock: curves of two clocks are not side by side
KEPT = 2000  # samples of a field for a page that is behind; of a whole array the newest
LONGEST_MESSAGE = 1_000_000  # bytes; a longer one would hold up the driver
Sample = Tuple[int, float, Any]  # number, time [s], value or values


def newer(samples: deque[Sample], known: int) -> list[list[Any]]:
    """Return the [t, value] of samples with a larger number, in their order."""
    last = takewhile(lambda sample: sample[0] > known, reversed(samples))
    return [[t, value] for _, t, value in last][::-1]


class Plots(Source):
    """Subscribes to what is drawn and keeps the newest samples."""

    watches: ClassVar = {"fields": (list_of(text, MOST_FIELDS), ()), "field_list": (switch, False)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._lock = threading.Lock()
        self._wanted: dict[str, dict[str, Any]] = {}  # topic -> {field: parts}
        self._samples: dict[str, deque[Sample]] = {}
        self._number = 0
        self._fields: list[str] = []
        self._fields_of: list[tuple[str, str]] | None = None  # topics and types

    def collect(self, clients: Sequence[Client], now: float) -> None:
        fields = {field for client in clients for field in client.watch.fields}
        wanted: dict[str, dict[str, Any]] = {}
        published, types = self._graphs.graph.published, self._graphs.graph.types
        for field in fields:
            topic, rest = split(field, published)
            parts = parts_of(rest)
            if topic and parts:  # else not now; a topic may come later
                wanted.setdefault(topic, {})[field] = parts
        self._wanted = wanted
        with self._lock:
            self._samples = {f: self._samples.get(f) or deque(maxlen=KEPT) for f in fields}
        self._feeds.set_subscriptions(self, dict.fromkeys(wanted, self._hear), every=True)
        topics = [(topic, types.get(topic, "")) for topic in published]
        if topics != self._fields_of and any(client.watch.field_list for client in clients):
            self._fields_of = topics
            self._fields = [f"{topic}/{one}" for topic, kind in topics for one in numbers_of(kind)]

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.field_list and client.take_if_new("fields", self._fields_of):
            client.send("fields", fields=self._fields)
        known = client.seen.get("plot", self._number)
        with self._lock:
            client.seen["plot"] = self._number
            new = {f: newer(self._samples.get(f, deque()), known) for f in client.watch.fields}
        new = {field: samples for field, samples in new.items() if samples}
        if new:
            client.send("plot", samples=new)

    def _hear(self, raw: Any, topic: str) -> None:
        kind = message_class(self._graphs.graph.types.get(topic, ""))
        message = kind and read(kind, raw.data, LONGEST_MESSAGE)
        if message is None:
            return
        now, header = rospy.get_time(), getattr(message, "header", None)
        stamp = header.stamp.to_sec() if header is not None else now
        t = round(stamp if abs(stamp - now) <= NEAR_S else now, 6)
        for field, parts in self._wanted.get(topic, {}).items():
            value = value_at(message, parts)
            if value is not None:
                with self._lock:
                    self._number += 1
                    if isinstance(value, list) and field in self._samples:
                        self._samples[field].clear()
                    if field in self._samples:
                        self._samples[field].append((self._number, t, value))
