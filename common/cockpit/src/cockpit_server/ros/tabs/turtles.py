"""The pictures of turtlesims; the node of this suite draws its field on request."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar, Sequence

import rosgraph

from cockpit_server.graph import GraphWatcher
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import switch
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

PERIOD_S, TIMEOUT_S = 0.1, 0.5  # between two requests to a node; for its answer
LONGEST_PICTURE = 1_000_000  # characters of base64


class Turtles(TabSource):
    """The pictures of the nodes that publish turtles, requested while a page shows them."""

    watches: ClassVar = {"turtles": (switch, False)}

    def __init__(self, graphs: GraphWatcher) -> None:
        self._graphs = graphs
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="turtles")
        self._pictures: dict[str, tuple[int, str]] = {}  # node -> version, PNG in base64
        self._is_asking, self._next_s = False, 0.0

    def collect(self, pages: Sequence[Page], now: float) -> None:
        watched = any(page.watch.turtles for page in pages)
        if not watched or self._is_asking or now < self._next_s:
            return
        self._is_asking, self._next_s = True, now + PERIOD_S
        self._thread.submit(self._ask, sorted(self._graphs.graph.turtlesims()))

    def _ask(self, nodes: Sequence[str]) -> None:
        newest = {node: self._newest(node, *self._pictures.get(node, (-1, ""))) for node in nodes}
        self._pictures = {node: picture for node, picture in newest.items() if picture}
        self._is_asking = False

    @staticmethod
    def _newest(node: str, version: int, picture: str) -> tuple[int, str] | None:
        _, uri = call(rosgraph.get_master_uri(), "lookupNode", node)
        answer, content = call(str(uri), "picture", version, timeout_s=TIMEOUT_S)
        if answer is Answer.SILENT:  # The node is busy.
            return version, picture
        types = list(map(type, content)) if isinstance(content, list) else []
        if types != [int, str] or len(content[1]) > LONGEST_PICTURE:  # The original has none.
            return None
        return content[0], content[1] or picture

    def send_to(self, page: Page, now: float) -> None:
        pictures, known = self._pictures, page.seen.get("turtles", {})
        versions = {node: version for node, (version, _) in pictures.items()}
        if page.watch.turtles and page.take_if_new("turtles", versions):
            new = {n: "" if known.get(n) == v else png for n, (v, png) in pictures.items()}
            page.send("turtles", pictures=new)
