"""Recordings on pages: opened, looked at, and played, which takes the place of the driver."""

import time
from concurrent.futures import ThreadPoolExecutor
from typing import ClassVar

from cockpit_server.clients import Source
from cockpit_server.player import Player
from cockpit_server.recording import JOY, RecordingError, Shelf, recordings
from cockpit_server.schema import number, switch, text
from cockpit_server.seat import BAG, RefusedError

LOOK_S = 2.0  # how often the folder is looked at for recordings, while a page shows them


class Opened:
    """What one page has opened. message: not sent yet."""

    def __init__(self, name, recording, message):
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

    def __init__(self, hub):
        self._hub = hub
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="recordings")
        self._shelf = Shelf()
        self._reading = set()  # numbers of the clients that wait for one
        self._names, self._next_look = {}, 0.0  # whether it may drive -> names; when [s]
        self._opened = {}  # client's number -> Opened
        self._player, self._owner = None, None

    def prepare(self, clients, now):
        numbers = {client.number for client in clients}
        self._opened = {n: opened for n, opened in self._opened.items() if n in numbers}
        self._shelf.in_use = tuple(opened.recording for opened in self._opened.values())
        if now >= self._next_look and any(client.watch.bag for client in clients):
            self._next_look = now + LOOK_S
            self._reader.submit(self._look)

    def _look(self):
        self._names = {may_drive: sorted(recordings(may_drive)) for may_drive in (False, True)}

    def give(self, client, now):
        names = self._names.get(client.drives)
        if client.watch.bag and names and client.lacks("bags", names):
            client.send("bags", names=names)
        opened = self._opened.get(client.number)
        if opened and opened.message:
            client.write(opened.message)
            opened.message = ""
        if not client.watch.bag or opened is None:
            return
        playing = self._plays(client.number)
        if playing:
            opened.position = self._player.position(now)
        at = (round(opened.position, 3), playing, opened.rate, opened.loop, opened.topic)
        if client.lacks("bag_at", at):
            names = ("position", "playing", "rate", "loop", "topic")
            client.send("bag_at", **dict(zip(names, at)))

    def on_bag_open(self, client, _now, name):
        if client.number in self._reading:
            raise RefusedError("a recording is being opened for this page: wait for it")
        if self._plays(client.number):
            self._hub.stand_up(client)
        self._reading.add(client.number)
        self._reader.submit(self._read, client, name)

    def _read(self, client, name):
        try:
            path = recordings(client.drives).get(name)
            if path is None:
                raise RecordingError(f"{name!r} is none of the recordings that may be opened here")
            recording, message = self._shelf.take(path)
        except Exception as error:  # whatever is in the file, the page gets the reason
            known = isinstance(error, RecordingError)
            why = str(error) if known else f"{name}: {type(error).__name__}: {error}"
            self._hub.soon(lambda: self._refuse(client, why))
            return
        self._hub.soon(lambda: self._show(client, Opened(name, recording, message)))

    def _refuse(self, client, why):
        self._reading.discard(client.number)
        client.refuse("bag_open", why, time.monotonic())

    def _show(self, client, opened):
        self._reading.discard(client.number)
        if self._plays(client.number):
            self._hub.stand_up(client)  # it was begun meanwhile, and is not what is shown
        self._opened[client.number] = opened
        client.seen.pop("bag_at", None)

    def on_bag_play(self, client, now, *, topic, rate, loop, robot):
        opened = self._must_be_open(client)
        kind = opened.recording.topics.get(topic, ("",))[0]
        if not kind:
            raise RefusedError(f"the recording has no topic {topic!r}")
        if kind != JOY:
            raise RefusedError(f"{topic} is of type {kind}: only {JOY} may be published from here")
        self._hub.sit_down(client, robot, BAG, now)
        opened.topic, opened.rate, opened.loop = topic, rate, loop
        messages, duration = opened.recording.joys[topic], opened.recording.duration
        self._player = Player(messages, duration, rate, loop)
        self._player.seek(opened.position, now)
        self._owner = client.number

    def on_bag_pause(self, client, now):
        if self._plays(client.number):
            self._opened[client.number].position = self._player.position(now)
            self._hub.stand_up(client)

    def on_bag_seek(self, client, now, position):
        opened = self._must_be_open(client)
        opened.position = min(position, opened.recording.duration)
        if self._plays(client.number):
            self._player.seek(opened.position, now)

    def _must_be_open(self, client):
        opened = self._opened.get(client.number)
        if opened is None:
            raise RefusedError("open a recording first")
        return opened

    def _plays(self, number):
        seat = self._hub.seat
        return self._player is not None and number == self._owner == seat.driver and seat.how == BAG

    def play(self, now):
        """Publish the messages that are due."""
        if self._player is None:
            return
        if not self._plays(self._owner):
            self._player = None  # the seat was lost
            return
        client = self._hub.clients[self._owner]
        for axes, buttons in self._player.due(now):
            self._hub.seat.play(axes, buttons)
        if self._player.is_over(now):
            self._opened[self._owner].position = 0.0
            self._hub.stand_up(client)
        elif client.is_cut():
            self._hub.lose("the network to the page that plays is down")
