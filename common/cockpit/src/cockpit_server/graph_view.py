"""The tab Graph: nodes and topics, and what a click on one of them brings."""

import math
import time
from typing import ClassVar

import rosgraph

from cockpit_server.clients import Source, encoded
from cockpit_server.feeds import later
from cockpit_server.plots import class_of
from cockpit_server.schema import full_name, or_null, switch
from node_kit.questions import Answer, call

PERIOD_S = 0.5
LONGEST_TEXT = 4000  # characters of the newest message
LONGEST_MESSAGE = 20_000  # bytes; the text of a longer one would hold up the driver
WINDOW_S = 2.0  # over which the rate is counted


class GraphView(Source):
    """Sends the graph to the pages that show it, whenever it has changed."""

    watches: ClassVar = {"graph": (switch, False), "node": (or_null(full_name), None)}

    def __init__(self, graph_watch):
        self._graphs = graph_watch
        self._written, self._text = None, ""  # a version, and its message
        self._pids, self._pids_of = {}, None  # node -> process, in a version of the graph

    def prepare(self, clients, _now):
        watched = any(client.watch.graph for client in clients)
        if watched and self._written != self._graphs.version:
            # The version first: what changes meanwhile is written down again.
            self._written = self._graphs.version
            self._text = encoded("graph", **self._graphs.graph.parts())
        if self._pids_of != self._graphs.version:
            self._pids, self._pids_of = {}, self._graphs.version
        for node in {client.watch.node for client in clients} - set(self._pids) - {None}:
            if node in self._graphs.graph.nodes:
                self._pids[node] = None
                later(self._ask_pid, node)

    def give(self, client, _now):
        if client.watch.graph and self._text and client.lacks("graph", self._written):
            client.write(self._text)
        node = client.watch.node
        if node and client.lacks("node", (node, self._graphs.version, self._pids.get(node))):
            about = self._graphs.graph.about_node(node)
            if self._pids.get(node):
                about["pid"] = self._pids[node]
            client.send("node", **about)

    def _ask_pid(self, node):
        answer, uri = call(rosgraph.get_master_uri(), "lookupNode", node)
        if answer is Answer.WELL:
            answer, pid = call(uri, "getPid")
            self._pids[node] = pid if answer is Answer.WELL else None


class Topic:
    """The messages of one topic."""

    def __init__(self):
        self.count, self.newest = 0, None
        self._marks = [(time.monotonic(), 0)]  # (when, count until then)

    def hear(self, message, _topic):
        self.newest = message.data
        self.count += 1

    def rate(self, now):
        """Return messages per second [Hz]; call about once a PERIOD_S."""
        self._marks.append((now, self.count))
        while len(self._marks) > 2 and self._marks[1][0] <= now - WINDOW_S:
            self._marks.pop(0)
        (since, before) = self._marks[0]
        return (self.count - before) / (now - since) if now > since else 0.0

    def text(self, type_name):
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

    def __init__(self, feeds, graph_watch):
        self._feeds, self._graphs = feeds, graph_watch
        self._topics = {}
        self._shown = {}  # name -> (since when [s], what pages are sent of it)

    def prepare(self, clients, now):
        graph = self._graphs.graph
        looked_at = {client.watch.topic for client in clients} - {None}
        self._topics = {name: self._topics.get(name) or Topic() for name in looked_at}
        there = {n: one.hear for n, one in self._topics.items() if n in graph.types}
        self._feeds.want(self, there, every=True)
        self._shown = {n: about for n, about in self._shown.items() if n in looked_at}

    def _about(self, graph, name, now):
        topic = self._topics[name]
        type_name = graph.types.get(name, "")
        return {
            "name": name,
            "type": type_name,
            "rate": round(topic.rate(now), 2),
            "publishers": sorted(graph.publishers.get(name, ())),
            "subscribers": sorted(graph.subscribers.get(name, ())),
            "last": topic.text(type_name),
        }

    def give(self, client, now):
        name = client.watch.topic
        if name not in self._topics:
            return
        since, about = self._shown.get(name, (-math.inf, None))
        if now - since >= PERIOD_S:
            since, about = now, self._about(self._graphs.graph, name, now)
            self._shown[name] = since, about
        if client.lacks("topic", (name, since)):
            client.send("topic", **about)
