"""The tab Bag: a page opens a recording, shows it, and plays topics of it."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any, ClassVar, Sequence

from cockpit_server.driving.player import Player
from cockpit_server.driving.reasons import sentence
from cockpit_server.driving.who_drives import Driving
from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, GraphWatcher
from cockpit_server.pages import Page, Soon, TabSource, encoded
from cockpit_server.ros.tabs.bag_files import bag_files, read, read_curves, version
from cockpit_server.ros.tabs.playback import Playback
from cockpit_server.schema import MOST_FIELDS, list_of, number, switch, text
from cockpit_server.tabs.publishing import VELOCITY
from cockpit_server.tabs.recordings import Recording, Shelf, playable
from gamepad.errors import BagError

LOOK_S = 2.0  # how often the folder is searched for recordings, while a page shows them
MOST_TOPICS = 200  # topics
UNUSED_S = 5.0  # after which publishers and messages are given up


class Opened:
    """The recording that a page has opened."""

    def __init__(self, recording: Recording) -> None:
        self.recording, self.position = recording, 0.0
        self.topics: Sequence[str] = ()  # played last
        self.sent: set[str] = set()  # fields whose curves the page has
        self.player: Player | None = None


class Bags(TabSource):
    """One recording for each page, of which at most one plays.

    Another thread reads files one after the other, one at a time for each page.
    """

    watches: ClassVar = {"bag": (switch, False), "bag_fields": (list_of(text, MOST_FIELDS), ())}
    messages: ClassVar = {
        "bag_open": {"name": text},
        "bag_play": {
            "topics": list_of(text, MOST_TOPICS), "rate": number(0.1, 10), "loop": switch,
            "robot": text,
        },
        "bag_pause": {},
        "bag_seek": {"position": number(0, 1e6)},
    }  # fmt: skip

    def __init__(self, driving: Driving, soon: Soon, graphs: GraphWatcher) -> None:
        self._driving, self._soon, self._graphs = driving, soon, graphs
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="recordings")
        self._shelf = Shelf()
        self._reading: set[int] = set()  # numbers of the pages for which a file is read
        self._drawing: set[Recording] = set()  # Their curves are being read.
        self._names: dict[bool, list[str]] = {}  # for pages that may drive, and for others
        self._next_look = 0.0  # [s]
        self._opened: dict[int, Opened] = {}  # by number of the page
        self._player: Player | None = None  # the newest
        self._used_at = 0.0  # [s] when it played last
        self._playback = Playback(graphs, driving.session)  # used by the reader

    def collect(self, pages: Sequence[Page], now: float) -> None:
        numbers = {page.number for page in pages}
        self._opened = {n: opened for n, opened in self._opened.items() if n in numbers}
        for page in pages:
            self._draw(page)
        if self._driving.plays(self._player):
            self._used_at = now
        elif self._player and now - self._used_at > UNUSED_S:
            self._player = None
            self._reader.submit(self._playback.close)
        if now >= self._next_look and any(page.watch.bag for page in pages):
            self._next_look = now + LOOK_S
            self._reader.submit(self._look)

    def _look(self) -> None:
        self._names = {may_drive: sorted(bag_files(may_drive)) for may_drive in (False, True)}

    def _draw(self, page: Page) -> None:
        """Read the curves that a page lacks."""
        opened = self._opened.get(page.number)
        missing = set(page.watch.bag_fields).difference(opened.recording.curves if opened else ())
        if opened and missing and opened.recording not in self._drawing:
            self._drawing.add(opened.recording)
            self._reader.submit(self._read_curves, opened.recording, missing)

    def _read_curves(self, recording: Recording, fields: set[str]) -> None:
        try:
            curves = read_curves(recording, fields)
        except Exception as error:  # whatever is in the file
            refusal = encoded("refused", what="bag_open", why=why_not(recording.path.name, error))
            curves = dict.fromkeys(fields, refusal)
        recording.keep(curves)
        self._drawing.discard(recording)

    def send_to(self, page: Page, now: float) -> None:
        names = self._names.get(page.drives)
        if page.watch.bag and names and page.take_if_new("bags", names):
            page.send("bags", names=names)
        opened = self._opened.get(page.number)
        if opened is None:
            return
        self._send_recording(page, opened)
        if opened.player:
            opened.position = opened.player.position(now)
        if not self._driving.plays(opened.player):
            opened.player = None
        plays = opened.player is not None
        at = {"position": round(opened.position, 3), "playing": plays, "topics": opened.topics}
        if page.watch.bag and page.take_if_new("bag_at", at):
            page.send("bag_at", **at)

    def _send_recording(self, page: Page, opened: Opened) -> None:
        refusal, graph = sentence(self._driving.why_not_free(page)), self._graphs.graph
        look = page.watch.look or ""
        if page.watch.bag and page.take_if_new("bag_busy", (opened, graph, look, refusal)):
            nodes = opened.recording.publishers(graph, look)
            page.send("bag_busy", nodes=nodes, refusal=refusal)
        if page.take_if_new("bag", opened):
            page.write(opened.recording.message)
        for field in page.watch.bag_fields:
            if field in opened.recording.curves and field not in opened.sent:
                opened.sent.add(field)
                page.write(opened.recording.curves[field])

    def on_bag_open(self, page: Page, now: float, name: str) -> None:
        self._must_not_read(page)
        self.on_bag_pause(page, now)
        self._reading.add(page.number)
        self._reader.submit(self._read, page, name)

    def _must_not_read(self, page: Page) -> None:
        if page.number in self._reading:
            raise RefusedError("a recording is being opened for this page: wait for it")

    def _read(self, page: Page, name: str) -> None:
        opened, why = None, ""
        try:
            path = bag_files(page.drives).get(name)
            if path is None:
                raise RefusedError(f"{name!r} is not a recording that may be opened here")
            opened = Opened(self._shelf.take(version(path), lambda: read(path)))
        except Exception as error:  # whatever is in the file; the page receives the reason
            why = why_not(name, error)
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
        self, page: Page, now: float, *, topics: Sequence[str], rate: float, loop: bool, robot: str
    ) -> None:
        opened = self._must_be_open(page)
        self._must_not_read(page)
        types = playable(opened.recording.types, topics, self._graphs.graph.types)
        if opened.player:
            opened.position = opened.player.position(now)
        player = Player(opened.recording.duration, rate, loop, opened.position)
        moving = [topic for topic, kind in types.items() if kind == VELOCITY]
        about = {"robot": robot} if JOY in types.values() else {"topic": [*moving, *topics][0]}
        self._driving.play(page, player, now, **about)
        opened.topics, opened.player, self._player = topics, player, player
        self._reading.add(page.number)
        self._reader.submit(self._load, page, opened.recording, topics, player)

    def _load(
        self, page: Page, recording: Recording, topics: Sequence[str], player: Player
    ) -> None:
        try:
            messages, ends = self._playback.load(recording, topics)
        except Exception as error:
            why = why_not(recording.path.name, error)
            self._soon(lambda: self._give_up(page, player, why))
        else:
            self._soon(lambda: self._begin(page, player, messages, ends))

    def _begin(self, page: Page, player: Player, messages: Any, ends: Any) -> None:
        self._reading.discard(page.number)
        if self._driving.plays(player):
            player.load(messages, ends, time.monotonic())

    def _give_up(self, page: Page, player: Player, why: str) -> None:
        self._reading.discard(page.number)
        page.refuse("bag_play", why)
        if self._driving.plays(player):
            self._driving.leave(page)

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


def why_not(name: str, error: Exception) -> str:
    if isinstance(error, (BagError, RefusedError)):
        return str(error)
    return f"{name}: {type(error).__name__}: {error}"
