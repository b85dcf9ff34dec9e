"""Connects the pages with what their tabs show. All of it runs in one thread."""

from __future__ import annotations

import itertools
from collections import deque
from typing import Any, Callable, Protocol, Sequence

from cockpit_server import limits
from cockpit_server.driving.who_drives import Driving
from cockpit_server.errors import RefusedError
from cockpit_server.failures import Guard
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import WATCH, Schema
from gamepad.gamepads import F710
from node_kit.rules.throttle import Throttle

BEAT_S = 0.05  # period of messages to the driver, and of robots to all pages
TICK_S = 0.01  # period at which the session and a recording that plays are given the time


class HubClock(Protocol):
    """What the hub uses of the module time."""

    def monotonic(self) -> float: ...
    def thread_time(self) -> float: ...


class Hub:
    """The exchange between the open pages and the sources of their tabs."""

    def __init__(
        self, pages: dict[int, Page], driving: Driving, sources: Sequence[TabSource],
        report: Callable[[str], None], clock: HubClock,
    ) -> None:  # fmt: skip
        """pages: by number; the hub adds and removes them. report: reports a failure at once."""
        self.pages, self._driving, self._sources = pages, driving, sources
        self._clock = clock
        self._guard = Guard(report)
        self._schema = Schema(sources)
        self._handlers: dict[str, Callable[..., None]] = {WATCH: self._on_watch}
        for source in sources:
            self._handlers.update({kind: getattr(source, f"on_{kind}") for kind in source.messages})
        self.page_numbers = itertools.count(1)
        self._messages = limits.Budget(limits.MESSAGES_BURST_S, limits.MESSAGE_S)
        self._sending = limits.Budget(limits.SENDING_BURST_S, 0.0)
        self._requests = limits.Budget(  # HTTP
            limits.REQUESTS_BURST_S, limits.REQUEST_S, limits.REQUESTS_DEBT_S
        )
        self._due: deque[int] = deque()  # numbers of the pages that are due to be sent something
        self._may_beat = Throttle(1 / BEAT_S, burst=1.5)  # regular, although the ticks are not

    def make_room(self, drives: bool) -> bool:
        """Return whether another page may be opened; a driver replaces the oldest viewer."""
        if len(self.pages) < limits.MOST_PAGES:
            return True
        viewer = next((page for page in self.pages.values() if not page.drives), None)
        if viewer is None or not drives:
            return False
        self.leave(viewer)
        viewer.close()
        return True

    def join(self, page: Page) -> None:
        self.pages[page.number] = page
        page.watch = self._schema.watch()
        buttons = {mode: pad.buttons for mode, pad in F710.items()}
        page.send("hello", id=page.number, role=page.role, buttons=buttons)

    def leave(self, page: Page) -> None:
        self.pages.pop(page.number, None)
        self._driving.gone(page)

    def wait_s(self, page: Page) -> float:
        """Return how long [s] the next message of a page waits, after the cost of earlier ones."""
        if self._driving.is_driver(page):
            return 0.0
        return self._messages.wait_s(self._clock.monotonic())

    def request_wait_s(self) -> float:
        """Return how long [s] an HTTP request waits."""
        return self._requests.wait_s(self._clock.monotonic())

    def receive(self, page: Page, data: Any) -> None:
        if page.number not in self.pages:
            return  # The page was closed while its message waited.
        began_s, kind = self._clock.thread_time(), "message"
        try:
            kind, fields = self._schema.check(data)
            self._handlers[kind](page, self._clock.monotonic(), **fields)
        except (ValueError, RefusedError) as error:
            page.refuse(kind, str(error))
        if not self._driving.is_driver(page):
            self._messages.spend(self._clock.thread_time() - began_s)

    def _on_watch(self, page: Page, _now: float, **fields: Any) -> None:
        # page.seen stays: a page keeps what it was sent, whichever tab it shows.
        page.watch = self._schema.watch(**fields)

    def tick(self) -> None:
        now = self._clock.monotonic()
        self._guard("driving", self._driving.tick, now)
        if self._may_beat.ready(now):
            self._driving.beat(now)
            self._call_sources("collect", list(self.pages.values()), now)
            waiting = set(self._due)
            self._due.extend(number for number in self.pages if number not in waiting)
        self._send(now)

    def _call_sources(self, method: str, *arguments: Any) -> None:
        for source in self._sources:
            self._guard(type(source).__name__, getattr(source, method), *arguments)

    def _send(self, now: float) -> None:
        """Send what pages lack, one page after the other, as far as the budget allows."""
        while self._due and not self._sending.wait_s(now):
            page, began_s = self.pages.get(self._due.popleft()), self._clock.thread_time()
            if page and not page.is_behind():  # else it is sent the newest later
                self._call_sources("send_to", page, now)
            self._sending.spend(self._clock.thread_time() - began_s)
