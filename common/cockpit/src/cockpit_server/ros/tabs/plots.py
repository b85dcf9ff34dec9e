"""The tab Plot: all values of the fields that pages draw."""

from __future__ import annotations

import threading
from collections import deque
from itertools import takewhile
from typing import Any, ClassVar, Sequence, Tuple

import rospy

from cockpit_server.fields import by_topic, numbers_of, value_at
from cockpit_server.graph import GraphWatcher
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import MOST_FIELDS, list_of, switch, text
from node_kit.message_types import message_class

NEAR_S = 1.0  # A stamp that differs more from the time is of another clock, and is not used.
KEPT = 2000  # samples of a field for a page that is behind; only the newest of a whole array
LONGEST_MESSAGE = 1_000_000  # bytes; a longer one would delay the driver
Sample = Tuple[int, float, Any]  # number, time [s], value or values


def newer(samples: deque[Sample], known: int) -> list[list[Any]]:
    """Return the [t, value] of samples with a larger number, in order."""
    last = takewhile(lambda sample: sample[0] > known, reversed(samples))
    return [[t, value] for _, t, value in last][::-1]


class Plots(TabSource):
    """The newest samples of the fields that pages draw."""

    watches: ClassVar = {"fields": (list_of(text, MOST_FIELDS), ()), "field_list": (switch, False)}

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._lock = threading.Lock()
        self._wanted: dict[str, dict[str, Any]] = {}  # topic -> {field: parts}
        self._samples: dict[str, deque[Sample]] = {}
        self._number = 0
        self._fields: list[str] = []
        self._fields_of: list[tuple[str, str]] | None = None  # topics and types

    def collect(self, pages: Sequence[Page], now: float) -> None:
        fields = {field for page in pages for field in page.watch.fields}
        published, types = self._graphs.graph.published, self._graphs.graph.types
        self._wanted = wanted = by_topic(fields, published)  # A topic may be published later.
        with self._lock:
            self._samples = {f: self._samples.get(f) or deque(maxlen=KEPT) for f in fields}
        handlers = dict.fromkeys(wanted, self._on_message)
        self._subscriptions.set_subscriptions(self, handlers, every=True)
        topics = [(topic, types.get(topic, "")) for topic in published]
        if topics != self._fields_of and any(page.watch.field_list for page in pages):
            self._fields_of = topics
            self._fields = [f"{topic}/{name}" for topic, of in topics for name in numbers_of(of)]

    def send_to(self, page: Page, now: float) -> None:
        if page.watch.field_list and page.take_if_new("fields", self._fields_of):
            page.send("fields", fields=self._fields)
        known = page.seen.get("plot", self._number)
        with self._lock:
            page.seen["plot"] = self._number
            new = {f: newer(self._samples.get(f, deque()), known) for f in page.watch.fields}
        new = {field: samples for field, samples in new.items() if samples}
        if new:
            page.send("plot", samples=new)

    def _on_message(self, raw: ReceivedMessage) -> None:
        kind = message_class(self._graphs.graph.types.get(raw.topic, ""))
        message = kind and decoded(kind, raw.data, LONGEST_MESSAGE)
        if message is None:
            return
        now, header = rospy.get_time(), getattr(message, "header", None)
        stamp = header.stamp.to_sec() if header is not None else now
        t = round(stamp if abs(stamp - now) <= NEAR_S else now, 6)
        for field, parts in self._wanted.get(raw.topic, {}).items():
            value = value_at(message, parts)
            if value is not None:
                with self._lock:
                    self._number += 1
                    if isinstance(value, list) and field in self._samples:
                        self._samples[field].clear()
                    if field in self._samples:
                        self._samples[field].append((self._number, t, value))
