"""The tab Graph: nodes and topics."""

from __future__ import annotations

from typing import ClassVar, Sequence

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.graph import Graph
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.schema import switch


class GraphView(Source):
    """Sends the graph to the pages that show it, whenever it has changed."""

    watches: ClassVar = {"graph": (switch, False)}

    def __init__(self, graph_watch: GraphWatch) -> None:
        self._graphs = graph_watch
        self._shown, self._text = Graph(), ""  # and its message to pages

    def collect(self, clients: Sequence[Client], now: float) -> None:
        graph = self._graphs.graph
        if graph is not self._shown and any(client.watch.graph for client in clients):
            self._shown, self._text = graph, encoded("graph", **graph.parts())

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.graph and self._text and client.take_if_new("graph", self._text):
            client.write(self._text)
