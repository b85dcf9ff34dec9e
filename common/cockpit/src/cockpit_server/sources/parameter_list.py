"""The tab Parameters: what is on the parameter server."""

from __future__ import annotations

import math
from typing import Any, ClassVar, Sequence

import rosgraph

from cockpit_server.clients import Client, Source
from cockpit_server.feeds import later
from cockpit_server.schema import switch
from node_kit.questions import Answer, call

PERIOD_S = 2.0
LONGEST_TEXT = 200  # characters of a value


def flat(value: Any, name: str = "") -> list[tuple[str, str]]:
    """Return (name, value as text) of each parameter in a tree of them, sorted by name."""
    if isinstance(value, dict) and value:
        return [pair for key in sorted(value) for pair in flat(value[key], f"{name}/{key}")]
    text = str(value)
    return [(name, text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}...")]


class ParameterList(Source):
    """Asks the master while a page shows the list."""

    watches: ClassVar = {"parameters": (switch, False)}

    def __init__(self) -> None:
        self._found: list[tuple[str, str]] = []
        self._asked_at, self._version = -math.inf, 0

    def prepare(self, clients: Sequence[Client], now: float) -> None:
        if now - self._asked_at >= PERIOD_S and any(one.watch.parameters for one in clients):
            self._asked_at = now
            later(self._ask)

    def give(self, client: Client, now: float) -> None:
        if client.watch.parameters and client.lacks("parameters", self._version):
            client.send("parameters", parameters=self._found)

    def _ask(self) -> None:
        answer, value = call(rosgraph.get_master_uri(), "getParam", "/")
        if answer is Answer.WELL and flat(value) != self._found:
            self._found = flat(value)
            self._version += 1
