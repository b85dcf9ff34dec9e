"""Recordings on pages: opened, looked at, and played, which takes the place of the driver."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any, ClassVar, Sequence

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.player import Player
from cockpit_server.graph import JOY
from cockpit_server.schema import number, switch, text
from cockpit_server.sources.recording import Recording, Shelf, recordings
from gamepad.bags import BagError

LOOK_S = 2.0  # how often the folder is looked at for recordings, while a page shows them


class Opened:
    """What one page has opened. message: not sent yet."""

    def __init__(self, name: str, recording: Recording, message: str) -> None:
        self.name, self.recording, self.message = name, recording, message
        self.position, self.rate, self.loop, self.topic = 0.0, 1.0, False, ""


class Bags(Source):
    """One recording for each page, and at most one that plays. Files are read in one other thread,
    one after the other, and for each page one at a time.
    """

    watches: ClassVar = {"bag": (switch, False)}
    messages: ClassVar = {
        "bag_open": {"name": text},
        "bag_play": {"topic": text, "rate": number(0.1, 10), "loop": switch, "robot": text},
        "bag_pause": {},
        "bag_seek": {"position": number(0, 1e6)},
    }

    def __init__(self, hub: Any) -> None:
        self._hub = hub
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="recordings")
        self._shelf = Shelf()
        self._reading: set[int] = set()  # numbers of the clients that wait for one
        self._names: dict[bool, list[str]] = {}  # for pages that may drive, and for others
        self._next_look = 0.0  # [s]
        self._opened: dict[int, Opened] = {}  # by client's number
        self._player: Player | None = None
        self._owner = 0  # number of the client that plays

    def collect(self, clients: Sequence[Client], now: float) -> None:
        numbers = {client.number for client in clients}
        self._opened = {n: opened for n, opened in self._opened.items() if n in numbers}
        self._shelf.in_use = tuple(opened.recording for opened in self._opened.values())
        if now >= self._next_look and any(client.watch.bag for client in clients):
            self._next_look = now + LOOK_S
            self._reader.submit(self._look)

    def _look(self) -> None:
        self._names = {may_drive: sorted(recordings(may_drive)) for may_drive in (False, True)}

    def send_to(self, client: Client, now: float) -> None:
        names = self._names.get(client.drives)
        if client.watch.bag and names and client.take_if_new("bags", names):
            client.send("bags", names=names)
        opened = self._opened.get(client.number)
        if opened and opened.message:
            client.write(opened.message)
            opened.message = ""
        if not client.watch.bag or opened is None:
            return
        player = self._playing(client.number)
        if player:
            opened.position = player.position(now)
        at = {
            "position": round(opened.position, 3), "playing": player is not None,
            "rate": opened.rate, "loop": opened.loop, "topic": opened.topic,
        }  # fmt: skip
        if client.take_if_new("bag_at", at):
            client.send("bag_at", **at)

    def on_bag_open(self, client: Client, now: float, name: str) -> None:
        if client.number in self._reading:
            raise RefusedError("a recording is being opened for this page: wait for it")
        self.on_bag_pause(client, now)
        self._reading.add(client.number)
        self._reader.submit(self._read, client, name)

    def _read(self, client: Client, name: str) -> None:
        opened, why = None, ""
        try:
            path = recordings(client.drives).get(name)
            if path is None:
                raise BagError(f"{name!r} is none of the recordings that may be opened here")
            opened = Opened(name, *self._shelf.take(path))
        except BagError as error:
            why = str(error)
        except Exception as error:  # whatever is in the file, the page gets the reason
            why = f"{name}: {type(error).__name__}: {error}"
        self._hub.soon(lambda: self._show(client, opened, why))

    def _show(self, client: Client, opened: Opened | None, why: str) -> None:
        now = time.monotonic()
        self._reading.discard(client.number)
        if opened is None:
            client.refuse("bag_open", why, now)
            return
        self.on_bag_pause(client, now)  # what was started meanwhile is not what is shown
        self._opened[client.number] = opened
        client.seen.pop("bag_at", None)

    def on_bag_play(
        self, client: Client, now: float, *, topic: str, rate: float, loop: bool, robot: str
    ) -> None:
        opened = self._must_be_open(client)
        kind = opened.recording.topics.get(topic, ("",))[0]
        if not kind:
            raise RefusedError(f"the recording has no topic {topic!r}")
        if kind != JOY:
            raise RefusedError(f"{topic} is of type {kind}: only {JOY} may be published from here")
        self._hub.sit_down(client, robot, now, plays=True)
        opened.topic, opened.rate, opened.loop = topic, rate, loop
        messages, duration = opened.recording.joys[topic], opened.recording.duration
        self._player = Player(messages, duration, rate, loop)
        self._player.seek(opened.position, now)
        self._owner = client.number

    def on_bag_pause(self, client: Client, now: float) -> None:
        player = self._playing(client.number)
        if player:
            self._opened[client.number].position = player.position(now)
            self._hub.stand_up(client)

    def on_bag_seek(self, client: Client, now: float, position: float) -> None:
        opened = self._must_be_open(client)
        opened.position = min(position, opened.recording.duration)
        player = self._playing(client.number)
        if player:
            player.seek(opened.position, now)

    def _must_be_open(self, client: Client) -> Opened:
        opened = self._opened.get(client.number)
        if opened is None:
            raise RefusedError("open a recording first")
        return opened

    def _playing(self, number: int) -> Player | None:
        """Return what a client plays, if anything."""
        session = self._hub.session
        return self._player if number == self._owner == session.driver and session.plays else None

    def play(self, now: float) -> None:
        """Publish the messages that are due."""
        player = self._player = self._playing(self._owner)
        if player is None:
            return
        client = self._hub.clients[self._owner]
        for axes, buttons in player.due(now):
            self._hub.session.play(axes, buttons)
        if player.is_over(now):
            self._opened[self._owner].position = 0.0
            self._hub.stand_up(client)
        elif client.is_cut():
            self._hub.lose("the network to the page that plays is down")
