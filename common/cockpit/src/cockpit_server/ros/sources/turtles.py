"""What turtlesims show: the node of this suite draws its field for those that ask."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar, Sequence

import rosgraph

from cockpit_server.clients import Client, Source
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.schema import switch
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

PERIOD_S, TIMEOUT_S = 0.1, 0.5  # between two questions to a node; for its answer
LONGEST_PICTURE = 1_000_000  # characters of base64


class Turtles(Source):
    """Asks the nodes that publish turtles for their pictures, while a page shows them."""

    watches: ClassVar = {"turtles": (switch, False)}

    def __init__(self, graph_watch: GraphWatch) -> None:
        self._graphs = graph_watch
        self._asker = ThreadPoolExecutor(1, thread_name_prefix="turtles")
        self._pictures: dict[str, tuple[int, str]] = {}  # node -> version, PNG in base64
        self._is_asking, self._next_s = False, 0.0

    def collect(self, clients: Sequence[Client], now: float) -> None:
        watched = any(client.watch.turtles for client in clients)
        if not watched or self._is_asking or now < self._next_s:
            return
        self._is_asking, self._next_s = True, now + PERIOD_S
        self._asker.submit(self._ask, sorted(self._graphs.graph.turtlesims()))

    def _ask(self, nodes: Sequence[str]) -> None:
        found = {node: self._newest(node, *self._pictures.get(node, (-1, ""))) for node in nodes}
        self._pictures = {node: one for node, one in found.items() if one}
        self._is_asking = False

    @staticmethod
    def _newest(node: str, version: int, picture: str) -> tuple[int, str] | None:
        _, uri = call(rosgraph.get_master_uri(), "lookupNode", node)
        answer, given = call(str(uri), "picture", version, timeout_s=TIMEOUT_S)
        if answer is Answer.SILENT:  # it is busy
            return version, picture
        types = [type(one) for one in given] if isinstance(given, list) else []
        if types != [int, str] or len(given[1]) > LONGEST_PICTURE:  # a real turtlesim has a window
            return None
        return given[0], given[1] or picture

    def send_to(self, client: Client, now: float) -> None:
        pictures, known = self._pictures, client.seen.get("turtles", {})
        versions = {node: version for node, (version, _) in pictures.items()}
        if client.watch.turtles and client.take_if_new("turtles", versions):
            new = {n: "" if known.get(n) == v else png for n, (v, png) in pictures.items()}
            client.send("turtles", pictures=new)
