"""Joins the pages with what they look at. All of it runs in one thread."""

from __future__ import annotations

import itertools
import time
from collections import deque
from typing import Any, Callable, Sequence

from cockpit_server import limits
from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.who_drives import Driving
from cockpit_server.failures import Guard
from cockpit_server.schema import WATCH, Schema
from gamepad.gamepads import F710
from node_kit.rules.throttle import Throttle

BEAT_S = 0.05  # period of messages to the driver, and of robots to all pages
TICK_S = 0.01  # how often the session and a recording that plays look at the time


class Hub:
    """What the open pages send, and what each of them is sent."""

    def __init__(
        self, pages: dict[int, Client], driving: Driving, sources: Sequence[Source],
        report: Callable[[str], None],
    ) -> None:  # fmt: skip
        """pages: by number; the hub lets them in and out. report: reports a failure at once."""
        self.pages, self._driving, self._sources = pages, driving, sources
        self._guard = Guard(report)
        self._schema = Schema(sources)
        self._handlers: dict[str, Callable[..., None]] = {WATCH: self._on_watch}
        for one in sources:
            self._handlers.update({kind: getattr(one, f"on_{kind}") for kind in one.messages})
        self.page_numbers = itertools.count(1)
        self._messages = limits.Budget(limits.MESSAGES_BURST_S, limits.MESSAGE_S)
        self._sending = limits.Budget(limits.SENDING_BURST_S, 0.0)
        self._requests = limits.Budget(  # HTTP
            limits.REQUESTS_BURST_S, limits.REQUEST_S, limits.REQUESTS_DEBT_S
        )
        self._due: deque[int] = deque()  # pages whose turn it is to be sent something
        self._may_beat = Throttle(1 / BEAT_S, burst=1.5)  # even, though the ticks are not

    def make_room(self, drives: bool) -> bool:
        """Return whether one more page may be opened; the oldest viewer makes room for a driver."""
        if len(self.pages) < limits.MOST_PAGES:
            return True
        viewer = next((page for page in self.pages.values() if not page.drives), None)
        if viewer is None or not drives:
            return False
        self.leave(viewer)
        viewer.close()
        return True

    def join(self, client: Client) -> None:
        self.pages[client.number] = client
        client.watch = self._schema.watch()
        buttons = {mode: pad.buttons for mode, pad in F710.items()}
        client.send("hello", id=client.number, role=client.role, buttons=buttons)

    def leave(self, client: Client) -> None:
        self.pages.pop(client.number, None)
        self._driving.gone(client)

    def wait_s(self, client: Client) -> float:
        """Return how long [s] the next message of a page waits, for what others have cost."""
        return 0.0 if self._driving.is_driver(client) else self._messages.wait_s(time.monotonic())

    def request_wait_s(self) -> float:
        """Return how long [s] an HTTP request waits."""
        return self._requests.wait_s(time.monotonic())

    def hear(self, client: Client, data: Any) -> None:
        if client.number not in self.pages:
            return  # it waited, and is gone
        began_s, kind = time.thread_time(), "message"
        try:
            kind, fields = self._schema.check(data)
            self._handlers[kind](client, time.monotonic(), **fields)
        except (ValueError, RefusedError) as error:
            client.refuse(kind, str(error))
        if not self._driving.is_driver(client):
            self._messages.spend(time.thread_time() - began_s)

    def _on_watch(self, client: Client, _now: float, **fields: Any) -> None:
        # What the page was sent it keeps, whichever tab it shows; a new connection is a new client.
        client.watch = self._schema.watch(**fields)

    def tick(self) -> None:
        now = time.monotonic()
        self._guard("driving", self._driving.tick, now)
        if self._may_beat.ready(now):
            self._driving.beat(now)
            self._each("collect", list(self.pages.values()), now)
            waiting = set(self._due)
            self._due.extend(number for number in self.pages if number not in waiting)
        self._give(now)

    def _each(self, method: str, *arguments: Any) -> None:
        for source in self._sources:
            self._guard(type(source).__name__, getattr(source, method), *arguments)

    def _give(self, now: float) -> None:
        """Send what pages lack, one page after the other, as far as the budget goes."""
        while self._due and not self._sending.wait_s(now):
            client, began_s = self.pages.get(self._due.popleft()), time.thread_time()
            if client and not client.is_behind():  # else it gets the newest once it has read
                self._each("send_to", client, now)
            self._sending.spend(time.thread_time() - began_s)
