"""Open pages, and what the tabs of a page show."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, Callable, ClassVar, Mapping, Sequence

from cockpit_server.access import DRIVER
from cockpit_server.errors import RefusedError

Soon = Callable[[Callable[[], object]], None]  # runs an action in the thread of the pages
LOOKS_ONLY = "this page was opened with the address for viewers: it may only look"


@dataclass(eq=False)
class Page:
    """A page that is open in a browser, and what can be done with its connection."""

    number: int
    role: str
    address: str  # IP address of its machine
    write: Callable[[str], None]  # sends a text, or drops it once the page is closed
    is_behind: Callable[[], bool]  # whether the last text has not been sent yet
    is_cut: Callable[[], bool]  # whether the network to it seems to be down
    close: Callable[[], None]
    watch: SimpleNamespace = field(default_factory=SimpleNamespace)  # see TabSource.watches
    seen: dict[Any, Any] = field(default_factory=dict)  # subject -> the newest version sent

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
        """Send why something was not done, unless other messages still wait to be sent."""
        if not self.is_behind():
            self.send("refused", what=what, why=why)

    def take_if_new(self, subject: Any, version: Any) -> bool:
        """Return whether the page lacks this version, and note that it is sent."""
        if self.seen.get(subject) == version:
            return False
        self.seen[subject] = version
        return True


class TabSource:
    """What a tab shows, and the messages that pages may send about it.

    watches: name -> (check of schema, value for a page that does not ask for it).
    messages: kind -> {field: check}; a message calls on_KIND(page, now [s], **fields).
    """

    watches: ClassVar[Mapping[str, tuple[Callable[[Any], Any], Any]]] = {}
    messages: ClassVar[Mapping[str, Mapping[str, Callable[[Any], Any]]]] = {}

    def collect(self, pages: Sequence[Page], now: float) -> None:
        """Gather what these pages show; called twenty times a second."""

    def send_to(self, page: Page, now: float) -> None:
        """Send a page what it lacks; nothing that was sent before is waiting."""


def encoded(kind: str, **fields: Any) -> str:
    """Return a message as JSON. Raises ValueError for infinity and NaN."""
    return json.dumps({"kind": kind, **fields}, allow_nan=False, separators=(",", ":"))
