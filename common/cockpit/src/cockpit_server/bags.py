"""Recordings on pages: opened, looked at, and played, which takes the place of the driver."""

import threading
import time
from pathlib import Path

import rospkg

from cockpit_server.clients import Source, encoded
from cockpit_server.player import Player
from cockpit_server.recording import JOY, RecordingError, curves, read
from cockpit_server.seat import BAG, RefusedError

TICKS = 2  # how often pages are told the position: each other time that they are looked after
MOST_NAMES = 100


def bags_here():
    """{name: path} of the recordings that may be opened: ours, and those of this folder."""
    ours = Path(rospkg.RosPack().get_path("gamepad")) / "bag" / "joy.bag"
    here = sorted(Path.cwd().glob("*.bag"))[:MOST_NAMES]
    return {path.name: path for path in [ours, *here]}


class Opened:
    """What one page has opened."""

    def __init__(self, name, recording):
        self.name, self.recording = name, recording
        self.position, self.rate, self.loop, self.topic = 0.0, 1.0, False, ""


class Bags(Source):
    """One recording for each page, and at most one that plays."""

    def __init__(self, hub):
        """hub: has the seat."""
        self._hub = hub
        self.handlers = {
            "bag_open": self._on_open, "bag_play": self._on_play,
            "bag_pause": self._on_pause, "bag_seek": self._on_seek,
        }  # fmt: skip
        self._opened = {}  # client's number -> Opened
        self._player, self._owner = None, None
        self._ticks = 0

    # ---------------------------------------------------------------- what pages are sent

    def prepare(self, clients, now):
        """Forget the pages that are gone."""
        self._ticks += 1
        numbers = {client.number for client in clients}
        self._opened = {n: opened for n, opened in self._opened.items() if n in numbers}

    def give(self, client, now):
        """Send what may be opened, and where the recording is."""
        if client.watch.bag and client.lacks("bags", True):
            client.send("bags", names=sorted(bags_here()))
        opened = self._opened.get(client.number)
        if not client.watch.bag or opened is None or self._ticks % TICKS:
            return
        playing = self._plays(client.number)
        if playing:
            opened.position = self._player.position(now)
        at = (round(opened.position, 3), playing, opened.rate, opened.loop, opened.topic)
        if client.lacks("bag_at", at):
            names = ("position", "playing", "rate", "loop", "topic")
            client.send("bag_at", **dict(zip(names, at)))

    # -------------------------------------------------------------------------- what they say

    def _on_open(self, client, _now, name):
        path = bags_here().get(name)
        if path is None:
            raise RefusedError(f"{name!r} is not among the recordings that may be opened here")
        if self._plays(client.number):
            self._hub.stand_up(client)
        threading.Thread(target=self._read, args=(client, name, path), daemon=True).start()

    def _read(self, client, name, path):
        try:
            recording = read(path)
            topics = [
                {"name": topic, "type": kind, "count": count}
                for topic, (kind, count) in sorted(recording.topics.items())
            ]
            # Before anything changes: what cannot be shown is not opened.
            text = encoded(
                "bag", path=name, start=recording.start, end=recording.end, topics=topics,
                curves=curves(recording.joys),
            )  # fmt: skip
        except Exception as error:  # whatever is in the file: who asked for it is told
            known = isinstance(error, RecordingError)
            why = str(error) if known else f"{name}: {type(error).__name__}: {error}"
            self._hub.soon(lambda: client.refuse("bag_open", why, time.monotonic()))
            return

        def show():
            if self._plays(client.number):
                self._hub.stand_up(client)  # it was begun meanwhile, and is not what is shown
            self._opened[client.number] = Opened(name, recording)
            client.seen.pop("bag_at", None)
            client.write(text)

        self._hub.soon(show)

    def _on_play(self, client, now, *, topic, rate, loop, robot):
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

    def _on_pause(self, client, now):
        if self._plays(client.number):
            self._opened[client.number].position = self._player.position(now)
            self._hub.stand_up(client)

    def _on_seek(self, client, now, position):
        opened = self._must_be_open(client)
        opened.position = min(position, opened.recording.duration)
        if self._plays(client.number):
            self._player.seek(opened.position, now)

    def _must_be_open(self, client):
        opened = self._opened.get(client.number)
        if opened is None:
            raise RefusedError("open a recording first")
        return opened

    # ------------------------------------------------------------------------------- playing

    def _plays(self, number):
        seat = self._hub.seat
        return self._player is not None and number == self._owner == seat.driver and seat.how == BAG

    def play(self, now):
        """Publish what is due."""
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
