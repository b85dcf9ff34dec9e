"""Recordings on pages: opened, looked at, and played, which takes the place of the driver."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar, Sequence

from cockpit_server.clients import Client, RefusedError, Soon, Source
from cockpit_server.driving.player import Player
from cockpit_server.driving.who_drives import Driving
from cockpit_server.graph import JOY
from cockpit_server.ros.sources.recording import Recording, Shelf, recordings
from cockpit_server.schema import number, switch, text
from gamepad.ros.bags import BagError

LOOK_S = 2.0  # how often the folder is looked at for recordings, while a page shows them


class Opened:
    """What one page has opened."""

    def __init__(self, recording: Recording) -> None:
        self.recording, self.position, self.topic = recording, 0.0, ""
        self.player: Player | None = None


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

    def __init__(self, driving: Driving, soon: Soon) -> None:
        self._driving, self._soon = driving, soon
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="recordings")
        self._shelf = Shelf()
        self._reading: set[int] = set()  # numbers of the clients that wait for one
        self._names: dict[bool, list[str]] = {}  # for pages that may drive, and for others
        self._next_look = 0.0  # [s]
        self._opened: dict[int, Opened] = {}  # by client's number

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
        if opened is None:
            return
        if client.take_if_new("bag", opened):
            client.write(opened.recording.message)
        if opened.player:
            opened.position = opened.player.position(now)
        if not self._driving.plays(opened.player):
            opened.player = None
        plays = opened.player is not None
        at = {"position": round(opened.position, 3), "playing": plays, "topic": opened.topic}
        if client.watch.bag and client.take_if_new("bag_at", at):
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
            opened = Opened(self._shelf.take(path))
        except BagError as error:
            why = str(error)
        except Exception as error:  # whatever is in the file, the page gets the reason
            why = f"{name}: {type(error).__name__}: {error}"
        self._soon(lambda: self._show(client, opened, why))

    def _show(self, client: Client, opened: Opened | None, why: str) -> None:
        self._reading.discard(client.number)
        if opened is None:
            client.refuse("bag_open", why)
            return
        # What was started meanwhile is not what is shown.
        self.on_bag_pause(client, time.monotonic())
        self._opened[client.number] = opened
        client.seen.pop("bag_at", None)

    def on_bag_play(
        self, client: Client, now: float, *, topic: str, rate: float, loop: bool, robot: str
    ) -> None:
        opened = self._must_be_open(client)
        kind = opened.recording.types.get(topic)
        if not kind:
            raise RefusedError(f"the recording has no topic {topic!r}")
        if kind != JOY:
            raise RefusedError(f"{topic} is of type {kind}: only {JOY} may be published from here")
        messages, duration = opened.recording.joys[topic], opened.recording.duration
        player = Player(messages, duration, rate, loop)
        player.seek(opened.position, now)
        self._driving.play(client, robot, player, now)
        opened.topic, opened.player = topic, player

    def on_bag_pause(self, client: Client, now: float) -> None:
        opened = self._opened.get(client.number)
        if opened and opened.player and self._driving.plays(opened.player):
            opened.position = opened.player.position(now)
            opened.player = None
            self._driving.leave(client)

    def on_bag_seek(self, client: Client, now: float, position: float) -> None:
        opened = self._must_be_open(client)
        opened.position = min(position, opened.recording.duration)
        if opened.player:
            opened.player.seek(opened.position, now)

    def _must_be_open(self, client: Client) -> Opened:
        opened = self._opened.get(client.number)
        if opened is None:
            raise RefusedError("open a recording first")
        return opened
