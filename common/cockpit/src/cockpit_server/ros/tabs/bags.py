"""The tab Bag: a page opens a recording, shows it, and plays it in the place of a driver."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar, Sequence

from cockpit_server.driving.player import Player
from cockpit_server.driving.who_drives import Driving
from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY
from cockpit_server.pages import Page, Soon, TabSource
from cockpit_server.ros.tabs.bag_files import bag_files, read, version
from cockpit_server.schema import number, switch, text
from cockpit_server.tabs.recordings import Recording, Shelf
from gamepad.errors import BagError

LOOK_S = 2.0  # how often the folder is searched for recordings, while a page shows them


class Opened:
    """The recording that a page has opened."""

    def __init__(self, recording: Recording) -> None:
        self.recording, self.position, self.topic = recording, 0.0, ""
        self.player: Player | None = None


class Bags(TabSource):
    """One recording for each page, of which at most one plays.

    Another thread reads files one after the other, one at a time for each page.
    """

    watches: ClassVar = {"bag": (switch, False)}
    messages: ClassVar = {
        "bag_open": {"name": text},
        "bag_play": {"topic": text, "rate": number(0.1, 10), "loop": switch, "robot": text},
        "bag_pause": {},
        "bag_seek": {"position": number(0, 1e6)},
    }

    def __init__(self, driving: Driving, soon: Soon) -> None:
        self._driving, self._soon = driving, soon
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="recordings")
        self._shelf = Shelf()
        self._reading: set[int] = set()  # numbers of the pages that wait for a recording
        self._names: dict[bool, list[str]] = {}  # for pages that may drive, and for others
        self._next_look = 0.0  # [s]
        self._opened: dict[int, Opened] = {}  # by number of the page

    def collect(self, pages: Sequence[Page], now: float) -> None:
        numbers = {page.number for page in pages}
        self._opened = {n: opened for n, opened in self._opened.items() if n in numbers}
        self._shelf.in_use = tuple(opened.recording for opened in self._opened.values())
        if now >= self._next_look and any(page.watch.bag for page in pages):
            self._next_look = now + LOOK_S
            self._reader.submit(self._look)

    def _look(self) -> None:
        self._names = {may_drive: sorted(bag_files(may_drive)) for may_drive in (False, True)}

    def send_to(self, page: Page, now: float) -> None:
        names = self._names.get(page.drives)
        if page.watch.bag and names and page.take_if_new("bags", names):
            page.send("bags", names=names)
        opened = self._opened.get(page.number)
        if opened is None:
            return
        if page.take_if_new("bag", opened):
            page.write(opened.recording.message)
        if opened.player:
            opened.position = opened.player.position(now)
        if not self._driving.plays(opened.player):
            opened.player = None
        plays = opened.player is not None
        at = {"position": round(opened.position, 3), "playing": plays, "topic": opened.topic}
        if page.watch.bag and page.take_if_new("bag_at", at):
            page.send("bag_at", **at)

    def on_bag_open(self, page: Page, now: float, name: str) -> None:
        if page.number in self._reading:
            raise RefusedError("a recording is being opened for this page: wait for it")
        self.on_bag_pause(page, now)
        self._reading.add(page.number)
        self._reader.submit(self._read, page, name)

    def _read(self, page: Page, name: str) -> None:
        opened, why = None, ""
        try:
            path = bag_files(page.drives).get(name)
            if path is None:
                raise RefusedError(f"{name!r} is not a recording that may be opened here")
            opened = Opened(self._shelf.take(version(path), lambda: read(path)))
        except (BagError, RefusedError) as error:
            why = str(error)
        except Exception as error:  # whatever is in the file; the page receives the reason
            why = f"{name}: {type(error).__name__}: {error}"
        self._soon(lambda: self._show(page, opened, why))

    def _show(self, page: Page, opened: Opened | None, why: str) -> None:
        self._reading.discard(page.number)
        if opened is None:
            page.refuse("bag_open", why)
            return
        # A recording that was started meanwhile is no longer shown.
        self.on_bag_pause(page, time.monotonic())
        self._opened[page.number] = opened
        page.seen.pop("bag_at", None)

    def on_bag_play(
        self, page: Page, now: float, *, topic: str, rate: float, loop: bool, robot: str
    ) -> None:
        opened = self._must_be_open(page)
        kind = opened.recording.types.get(topic)
        if not kind:
            raise RefusedError(f"the recording has no topic {topic!r}")
        if kind != JOY:
            raise RefusedError(f"{topic} is of type {kind}: only {JOY} may be published from here")
        messages, duration = opened.recording.joys[topic], opened.recording.duration
        player = Player(messages, duration, rate, loop)
        player.seek(opened.position, now)
        self._driving.play(page, robot, player, now)
        opened.topic, opened.player = topic, player

    def on_bag_pause(self, page: Page, now: float) -> None:
        opened = self._opened.get(page.number)
        if opened and opened.player and self._driving.plays(opened.player):
            opened.position = opened.player.position(now)
            opened.player = None
            self._driving.leave(page)

    def on_bag_seek(self, page: Page, now: float, position: float) -> None:
        opened = self._must_be_open(page)
        opened.position = min(position, opened.recording.duration)
        if opened.player:
            opened.player.seek(opened.position, now)

    def _must_be_open(self, page: Page) -> Opened:
        opened = self._opened.get(page.number)
        if opened is None:
            raise RefusedError("open a recording first")
        return opened
