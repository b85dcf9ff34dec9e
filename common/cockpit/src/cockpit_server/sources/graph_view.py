"""The tab Graph: nodes and topics, and what a click on one of them brings."""

from __future__ import annotations

import math
import time
from typing import Any, ClassVar, Sequence

import rosgraph

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.feeds import Feeds, later
from cockpit_server.graph import Graph
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import full_name, or_null, switch
from cockpit_server.sources.plots import class_of
from node_kit.ros_api import Answer, call

PERIOD_S = 0.5
LONGEST_TEXT = 4000  # characters of the newest message
LONGEST_MESSAGE = 20_000  # bytes; the text of a longer one would hold up the driver
WINDOW_S = 2.0  # over which the rate is counted


class GraphView(Source):
    """Sends the graph to the pages that show it, whenever it has changed."""

    watches: ClassVar = {"graph": (switch, False), "node": (or_null(full_name), None)}

    def __init__(self, graph_watch: GraphWatch) -> None:
        self._graphs = graph_watch
        self._version, self._text = -1, ""  # the graph's version, and its message to pages
        self._pids: dict[str, int | None] = {}  # node -> process, in that version

    def prepare(self, clients: Sequence[Client], now: float) -> None:
        if self._version != self._graphs.version:
            # The version first: what changes meanwhile is written down again.
            self._version, self._text, self._pids = self._graphs.version, "", {}
        if not self._text and any(client.watch.graph for client in clients):
            self._text = encoded("graph", **self._graphs.graph.parts())
        for node in {client.watch.node for client in clients} - set(self._pids) - {None}:
            if node in self._graphs.graph.nodes:
                self._pids[node] = None
                later(self._ask_pid, node)

    def give(self, client: Client, now: float) -> None:
        if client.watch.graph and self._text and client.lacks("graph", self._version):
            client.write(self._text)
        node, pid = client.watch.node, self._pids.get(client.watch.node)
        if client.lacks("node", node and (node, self._graphs.version, pid)) and node:
            about = self._graphs.graph.about_node(node)
            client.send("node", **about, **({"pid": pid} if pid else {}))

    def _ask_pid(self, node: str) -> None:
        answer, uri = call(rosgraph.get_master_uri(), "lookupNode", node)
        if answer is Answer.WELL:
            answer, pid = call(uri, "getPid")
            self._pids[node] = pid if answer is Answer.WELL else None


class Topic:
    """The messages of one topic."""

    def __init__(self) -> None:
        self.count = 0
        self.newest: bytes | None = None
        self.shown_at = -math.inf  # [s]
        self.shown: dict[str, Any] = {}  # what pages are sent since then
        self._marks = [(time.monotonic(), 0)]  # (when, count until then)

    def hear(self, message: Any, _topic: str) -> None:
        self.newest = message.data
        self.count += 1

    def rate(self, now: float) -> float:
        """Return messages per second [Hz]; call about once a PERIOD_S."""
        self._marks.append((now, self.count))
        while len(self._marks) > 2 and self._marks[1][0] <= now - WINDOW_S:
            self._marks.pop(0)
        (since, before) = self._marks[0]
        return (self.count - before) / (now - since) if now > since else 0.0

    def text(self, type_name: str) -> str:
        """Return the newest message as text."""
        data = self.newest
        if data is None:
            return ""
        kind = class_of(type_name)
        if kind is None:
            return f"({len(data)} bytes; the package of {type_name} is not installed here)"
        if len(data) > LONGEST_MESSAGE:
            return f"({len(data)} bytes)"
        try:
            text = str(kind().deserialize(data))
        except Exception as error:  # whatever the bytes made a message class do
            return f"(cannot be read: {error})"
        return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}\n..."


class Topics(Source):
    """The topics that pages show; a page shows one."""

    watches: ClassVar = {"topic": (or_null(full_name), None)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._topics: dict[str, Topic] = {}

    def prepare(self, clients: Sequence[Client], now: float) -> None:
        looked_at = {client.watch.topic for client in clients} - {None}
        self._topics = {name: self._topics.get(name) or Topic() for name in looked_at}
        types = self._graphs.graph.types
        there = {name: one.hear for name, one in self._topics.items() if name in types}
        self._feeds.want(self, there, every=True)

    def give(self, client: Client, now: float) -> None:
        name = client.watch.topic
        topic = self._topics.get(name)
        if topic is None:
            return
        if now - topic.shown_at >= PERIOD_S:
            topic.shown_at, topic.shown = now, _about(self._graphs.graph, name, topic, now)
        if client.lacks("topic", (name, topic.shown_at)):
            client.send("topic", **topic.shown)


def _about(graph: Graph, name: str, topic: Topic, now: float) -> dict[str, Any]:
    type_name = graph.types.get(name, "")
    return {
        "name": name,
        "type": type_name,
        "rate": round(topic.rate(now), 2),
        "publishers": sorted(graph.publishers.get(name, ())),
        "subscribers": sorted(graph.subscribers.get(name, ())),
        "last": topic.text(type_name),
    }
