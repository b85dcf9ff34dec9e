"""The graph as pages see it, and what a click on a node brings."""

import rosgraph

from cockpit_server.clients import Source, encoded
from cockpit_server.feeds import later
from node_kit.questions import Answer, call


class GraphView(Source):
    """Sends the graph to those who look at it, whenever it has changed."""

    def __init__(self, graph_watch):
        """graph_watch: knows the graph."""
        self._graphs = graph_watch
        self._written, self._text = None, ""  # a version, and its message
        self._pids, self._pids_of = {}, None  # node -> process, in a version of the graph

    def prepare(self, clients, _now):
        """Write it down if somebody looks and it has changed."""
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
        """Send what has changed."""
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
