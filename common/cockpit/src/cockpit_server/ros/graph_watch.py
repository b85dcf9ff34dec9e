"""Asks the master for the graph, once a second, and sends it to the pages that show it."""

from __future__ import annotations

import threading
import time
from typing import Callable, ClassVar
from urllib.parse import urlsplit

import rosgraph

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.graph import Graph, topic_of, without
from cockpit_server.schema import switch
from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

PERIOD_S = 1.0
MASTER_S = 0.2  # How often to check that it is there; until then a form drives on.
NODE_S = 0.3  # A node that runs accepts a connection within this time.


class GraphWatch(Source):
    """The newest Graph, of this node only what it publishes; another one after each change."""

    watches: ClassVar = {"graph": (switch, False)}

    def __init__(self, own_name: str) -> None:
        self._own_name = own_name
        self._uri = rosgraph.get_master_uri()
        self.graph, self._text = Graph(), ""  # and its message to pages
        self._is_lost = False
        self._pid: int | None = None  # the master's, once known
        self.look()

    def send_to(self, client: Client, now: float) -> None:
        if client.watch.graph and self._text and client.take_if_new("graph", self._text):
            client.write(self._text)

    def joysticks(self, robot: str) -> tuple[str, ...]:
        """Return the names of the other nodes that publish a robot's joystick."""
        nodes = self.graph.publishers.get(topic_of(robot, "joy"), frozenset())
        return tuple(sorted(nodes - {self._own_name}))

    def joystick_listeners(self, robot: str) -> frozenset[str]:
        """Return the names of the other nodes that subscribe to a robot's joystick."""
        return self.graph.subscribers.get(topic_of(robot, "joy"), frozenset())

    def start(self, lost: Callable[[], None]) -> None:
        """Look once a second, in a thread. lost: called when the master has gone."""
        threading.Thread(target=self._run, args=(lost,), daemon=True).start()

    def _run(self, lost: Callable[[], None]) -> None:
        next_look_s = time.monotonic() + PERIOD_S
        while not self._is_lost:
            time.sleep(MASTER_S)
            if call(self._uri, "getPid", caller=self._own_name)[0] is Answer.REFUSED:
                self._is_lost = True
            elif time.monotonic() >= next_look_s:
                self.look()
                next_look_s = time.monotonic() + PERIOD_S
        lost()

    def look(self) -> None:
        answer, state = call(self._uri, "getSystemState", caller=self._own_name)
        if answer is Answer.SILENT:
            return
        answered, pid = call(self._uri, "getPid", caller=self._own_name)
        heard, types = call(self._uri, "getTopicTypes", caller=self._own_name)
        named, parameters = call(self._uri, "getParamNames", caller=self._own_name)
        if answer is Answer.WELL and Answer.SILENT in (answered, heard, named):
            return  # it is busy, and is asked again
        if self._pid is None:
            self._pid = pid
        if {answer, answered} != {Answer.WELL} or pid != self._pid:
            self._is_lost = True
            return
        types, shown = dict(types or []), {topic for topic, _ in state[0]} - {"/rosout"}
        known = self.graph.machines
        names = {n for part in state for _, nodes in part for n in nodes}
        machines = {n: known.get(n) or self._machine(n) for n in names - {self._own_name}}
        dead = {name for name, machine in machines.items() if machine is None}
        publishers = without({self._own_name}, without(dead, state[0]).items(), shown_in=shown)
        subscribers, services = [without({self._own_name, *dead}, part) for part in state[1:]]
        graph = Graph(publishers, subscribers, services, types, parameters=sorted(parameters or []))
        graph.machines.update({n: machines.get(n) or "" for n in graph.nodes})
        if graph != self.graph:
            self.graph, self._text = graph, encoded("graph", **graph.parts())

    def _machine(self, node: str) -> str | None:
        """Return the machine of a node; None if it was killed without the master's knowledge."""
        answer, uri = call(self._uri, "lookupNode", node, caller=self._own_name)
        if answer is not Answer.WELL:
            return ""
        answer, _ = call(uri, "getPid", caller=self._own_name, timeout_s=NODE_S)
        return None if answer is Answer.REFUSED else urlsplit(uri).hostname or ""
