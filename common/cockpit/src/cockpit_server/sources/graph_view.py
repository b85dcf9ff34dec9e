"""The tab Graph: nodes and topics."""

from __future__ import annotations

from typing import ClassVar, Sequence

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import switch


class GraphView(Source):
    """Sends the graph to the pages that show it, whenever it has changed."""

    watches: ClassVar = {"graph": (switch, False)}

    def __init__(self, graph_watch: GraphWatch) -> None:
        self._graphs = graph_watch
        self._version, self._text = -1, ""  # the graph's version, and its message to pages

    def collect(self, clients: Sequence[Client], now: float) -> None:
        version = self._graphs.version  # first: what changes meanwhile is written down again
        if self._version != version and any(client.watch.graph for client in clients):
            self._version, self._text = version, encoded("graph", **self._graphs.graph.parts())

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.graph and self._text and client.take_if_new("graph", self._version):
            client.write(self._text)
