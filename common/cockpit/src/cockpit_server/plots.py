"""Curves of numbers in messages, every one of them, for the pages that draw them."""

import threading
from collections import deque
from functools import lru_cache
from itertools import takewhile
from math import isfinite
from typing import ClassVar

import roslib.message
import rospy

from cockpit_server.clients import Source
from cockpit_server.fields import numeric_fields, parts_of, split, value_at
from cockpit_server.schema import MOST_FIELDS, list_of, switch, text

NEAR_S = 1.0  # of a stamp and this clock; curves of two clocks would not be seen side by side
KEPT = 2000  # samples of a field for a page that is behind


@lru_cache(maxsize=None)
def class_of(type_name):
    """Return the class of a message type, or None if its package is not installed."""
    try:
        return roslib.message.get_message_class(type_name)
    except Exception:  # whatever a package that is half there brings about
        return None


@lru_cache(maxsize=None)
def fields_of(type_name):
    """Return the names of all numbers in messages of a type, rarely drawn ones last."""
    kind = class_of(type_name)
    return tuple(sorted(numeric_fields(kind, class_of), key=is_seldom_drawn)) if kind else ()


def is_seldom_drawn(field):
    return "header/" in field or "covariance" in field


def newer(samples, known):
    """Return the [t, value] of samples with a larger number, in their order."""
    last = takewhile(lambda sample: sample[0] > known, reversed(samples))
    return [[t, value] for _, t, value in last][::-1]


class Plots(Source):
    """Subscribes to what is drawn and keeps the newest samples."""

    watches: ClassVar = {"fields": (list_of(text, MOST_FIELDS), ()), "field_list": (switch, False)}

    def __init__(self, feeds, graph_watch):
        self._feeds, self._graphs = feeds, graph_watch
        self._lock = threading.Lock()
        self._wanted = {}  # topic -> {field: parts}
        self._classes = {}  # topic -> class of its messages
        self._samples = {}  # field -> deque of (number, time [s], value)
        self._number = 0
        self._fields, self._fields_of = [], None

    def prepare(self, clients, _now):
        fields = {field for client in clients for field in client.watch.fields}
        graph, wanted = self._graphs.graph, {}
        published = graph.published
        for field in fields:
            try:
                topic, rest = split(field, published)
                wanted.setdefault(topic, {})[field] = parts_of(rest)
            except ValueError:
                continue  # not now; a topic may come later
        self._wanted = wanted
        with self._lock:
            self._samples = {f: self._samples.get(f) or deque(maxlen=KEPT) for f in fields}
        self._classes = {topic: class_of(graph.types.get(topic, "")) for topic in wanted}
        self._feeds.want(self, dict.fromkeys(wanted, self._hear), every=True)
        if any(client.watch.field_list for client in clients):
            self._list_fields(graph)

    def _list_fields(self, graph):
        topics = tuple((topic, graph.types.get(topic, "")) for topic in graph.published)
        if topics != self._fields_of:
            self._fields_of = topics
            self._fields = [f"{topic}/{name}" for topic, kind in topics for name in fields_of(kind)]

    def give(self, client, now):
        if client.watch.field_list and client.lacks("fields", self._fields_of):
            client.send("fields", fields=self._fields)
        if not client.watch.fields:
            return
        known = client.seen.get("plot", self._number)
        with self._lock:
            client.seen["plot"] = self._number
            new = {
                field: newer(self._samples[field], known)
                for field in client.watch.fields
                if field in self._samples
            }
        new = {field: samples for field, samples in new.items() if samples}
        if new:
            client.send("plot", samples=new)

    def _hear(self, raw, topic):
        kind = self._classes.get(topic)
        if kind is None:
            return
        try:
            message = kind().deserialize(raw.data)
        except Exception:  # whatever the bytes made a message class do
            return
        header = getattr(message, "header", None)
        now = rospy.get_time()
        stamp = header.stamp.to_sec() if hasattr(header, "stamp") else now
        t = round(stamp if abs(stamp - now) <= NEAR_S else now, 6)
        for field, parts in self._wanted.get(topic, {}).items():
            value = value_at(message, parts)
            if value is not None and isfinite(value):
                with self._lock:
                    self._number += 1
                    if field in self._samples:
                        self._samples[field].append((self._number, t, value))
