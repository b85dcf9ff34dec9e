"""The tab Graph: nodes and topics, and what a click on one of them brings."""

from __future__ import annotations

from typing import ClassVar, Sequence

import rosgraph

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.feeds import later
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import full_name, or_null, switch
from node_kit.ros_api import Answer, call


class GraphView(Source):
    """Sends the graph to the pages that show it, whenever it has changed."""

    watches: ClassVar = {"graph": (switch, False), "node": (or_null(full_name), None)}

    def __init__(self, graph_watch: GraphWatch) -> None:
        self._graphs = graph_watch
        self._version, self._text = -1, ""  # the graph's version, and its message to pages
        self._pids: dict[str, int | None] = {}  # node -> process, in that version

    def collect(self, clients: Sequence[Client], now: float) -> None:
        if self._version != self._graphs.version:
            # The version first: what changes meanwhile is written down again.
            self._version, self._text, self._pids = self._graphs.version, "", {}
        if not self._text and any(client.watch.graph for client in clients):
            self._text = encoded("graph", **self._graphs.graph.parts())
        for node in {client.watch.node for client in clients} - set(self._pids) - {None}:
            if node in self._graphs.graph.nodes:
                self._pids[node] = None
                later(self._ask_pid, node)

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.graph and self._text and client.take_if_new("graph", self._version):
            client.write(self._text)
        node, pid = client.watch.node, self._pids.get(client.watch.node)
        if client.take_if_new("node", node and (node, self._graphs.version, pid)) and node:
            about = self._graphs.graph.about_node(node)
            client.send("node", **about, **({"pid": pid} if pid else {}))

    def _ask_pid(self, node: str) -> None:
        answer, uri = call(rosgraph.get_master_uri(), "lookupNode", node)
        if answer is Answer.WELL:
            answer, pid = call(uri, "getPid")
            self._pids[node] = pid if answer is Answer.WELL else None
