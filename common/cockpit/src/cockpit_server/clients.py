"""One page that is open somewhere, as the rest of the server sees it (pure)."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, Callable, ClassVar, Mapping, Sequence

from cockpit_server.access import DRIVER

Soon = Callable[[Callable[[], object]], None]  # runs an action in the thread of the pages
LOOKS_ONLY = "this page was opened with the address for viewers: it may only look"


class RefusedError(Exception):
    """Something cannot be done; the text says why in one line."""


@dataclass(eq=False)
class Client:
    """A page, by what can be done with its connection."""

    number: int
    role: str
    address: str  # IP address of its machine
    write: Callable[[str], None]  # sends a text, or drops it once the page is closed
    is_behind: Callable[[], bool]  # whether the last text has not gone out yet
    is_cut: Callable[[], bool]  # whether the network to it seems to be down
    close: Callable[[], None]
    watch: SimpleNamespace = field(default_factory=SimpleNamespace)  # what it wants to see: Source
    seen: dict[Any, Any] = field(default_factory=dict)  # about what: the newest version sent

    @property
    def name(self) -> str:
        return f"page {self.number} ({self.address})"

    @property
    def drives(self) -> bool:
        return self.role == DRIVER

    def must_drive(self) -> None:
        if not self.drives:
            raise RefusedError(LOOKS_ONLY)

    def send(self, kind: str, **fields: Any) -> None:
        self.write(encoded(kind, **fields))

    def refuse(self, what: str, why: str) -> None:
        """Report what was not done and why, unless that would wait behind other messages."""
        if not self.is_behind():
            self.send("refused", what=what, why=why)

    def take_if_new(self, about: Any, version: Any) -> bool:
        """Return whether the client lacks this version; from now on it has it."""
        if self.seen.get(about) == version:
            return False
        self.seen[about] = version
        return True


class Source:
    """Something that pages see, and the messages that they may send about it.

    watches: name -> (check of schema, value for a page that does not ask for it).
    messages: kind -> {field: check}; each calls on_KIND(client, now [s], **fields).
    """

    watches: ClassVar[Mapping[str, tuple[Callable[[Any], Any], Any]]] = {}
    messages: ClassVar[Mapping[str, Mapping[str, Callable[[Any], Any]]]] = {}

    def collect(self, clients: Sequence[Client], now: float) -> None:
        """Gather what these clients want to see; twenty times a second."""

    def send_to(self, client: Client, now: float) -> None:
        """Send a client what it lacks; it has read all that was sent before."""


def encoded(kind: str, **fields: Any) -> str:
    """Return a message as JSON; infinity is a ValueError."""
    return json.dumps({"kind": kind, **fields}, allow_nan=False, separators=(",", ":"))
