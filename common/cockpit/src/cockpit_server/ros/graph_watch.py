"""Asks the master for the graph once a second, for the tab Graph and all others."""

from __future__ import annotations

import threading
import time
from typing import Callable, ClassVar
from urllib.parse import urlsplit

import rosgraph

from cockpit_server.graph import Graph, graph_of
from cockpit_server.pages import Page, TabSource, encoded
from cockpit_server.schema import switch
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

PERIOD_S = 1.0
MASTER_S = 0.2  # how often to check that the master runs; until then a form drives on
NODE_S = 0.3  # A running node accepts a connection within this time.


class GraphWatch(TabSource):
    """The newest Graph, a new object after each change."""

    watches: ClassVar = {"graph": (switch, False)}

    def __init__(self, own_name: str) -> None:
        self._own_name = own_name
        self._uri = rosgraph.get_master_uri()
        self.graph, self._text = Graph(own_name=own_name), ""  # and its message to pages
        self.looked_at = 0.0  # by time.monotonic(), when the newest answered look began
        self._is_lost, self._is_due = False, threading.Event()
        self._pid: int | None = None  # the master's, once known
        self.look()

    def send_to(self, page: Page, now: float) -> None:
        if page.watch.graph and self._text and page.take_if_new("graph", self._text):
            page.write(self._text)

    def start(self, lost: Callable[[], None]) -> None:
        """Look once a second, in a thread. lost: called when the master has exited."""
        threading.Thread(target=self._run, args=(lost,), daemon=True).start()

    def _run(self, lost: Callable[[], None]) -> None:
        next_look_s = time.monotonic() + PERIOD_S
        while not self._is_lost:
            is_due = self._is_due.wait(MASTER_S)
            if call(self._uri, "getPid", caller=self._own_name)[0] is Answer.REFUSED:
                self._is_lost = True
            elif is_due or time.monotonic() >= next_look_s:
                self._is_due.clear()
                self.look()
                next_look_s = time.monotonic() + PERIOD_S
        lost()

    def look_soon(self) -> None:
        self._is_due.set()

    def look(self) -> None:
        """Ask the master once, and note whether it is still the same one."""
        began_s = time.monotonic()
        answer, state = call(self._uri, "getSystemState", caller=self._own_name)
        if answer is Answer.SILENT:
            return
        answered, pid = call(self._uri, "getPid", caller=self._own_name)
        typed, types = call(self._uri, "getTopicTypes", caller=self._own_name)
        named, parameters = call(self._uri, "getParamNames", caller=self._own_name)
        if answer is Answer.WELL and Answer.SILENT in (answered, typed, named):
            return  # The master is busy, and is asked again.
        if self._pid is None:
            self._pid = pid
        if {answer, answered} != {Answer.WELL} or pid != self._pid:
            self._is_lost = True
            return
        known = self.graph.machines
        names = {node for column in state for _, nodes in column for node in nodes}
        machines = {n: known.get(n) or self._machine(n) for n in names - {self._own_name}}
        graph = graph_of(state, dict(types or []), parameters or [], machines, self._own_name)
        if graph != self.graph:
            self.graph, self._text = graph, encoded("graph", **graph.parts())
        self.looked_at = began_s

    def _machine(self, node: str) -> str | None:
        """Return the machine of a node; None if it was killed without the master's knowledge."""
        answer, uri = call(self._uri, "lookupNode", node, caller=self._own_name)
        if answer is not Answer.WELL:
            return ""
        answer, _ = call(uri, "getPid", caller=self._own_name, timeout_s=NODE_S)
        return None if answer is Answer.REFUSED else urlsplit(uri).hostname or ""
