"""Joins the pages with what they look at and what they drive. All of it runs in one thread."""

import time

from cockpit_server.clients import Watch
from cockpit_server.feeds import later
from cockpit_server.guard import Guard
from cockpit_server.schema import MODES, check_lengths, check_message
from cockpit_server.seat import PAGE, Input, RefusedError, Seat
from gamepad.gamepads import F710
from node_kit.throttle import Throttle

BEAT_S = 0.05  # of the server to who drives, and of the robots to all
TICK_S = 0.01  # how often the seat and a recording that plays look at the time


class Hub:
    """The pages that are open, who of them drives, and what each is sent."""

    def __init__(self, soon, graph_watch, joysticks, pads, tell):
        """soon: called in any thread with what is to be called in this one. pads: knows who else
        moves a robot. tell: called with a line about what has failed; it must not wait.
        """
        self._guard = Guard(tell)
        self.soon, self._graphs, self._joysticks, self._pads = soon, graph_watch, joysticks, pads
        self._sources, self._player = [], None
        self._handlers = {
            "watch": self._on_watch, "drive": self._on_drive, "leave": self._on_leave,
            "hand_over": self._on_hand_over, "input": self._on_input, "release": self._on_release,
        }  # fmt: skip
        self.clients = {}
        self._next_number, self._beats = 1, 0
        self._may_beat = Throttle(1 / BEAT_S, burst=1.5)  # even, though the ticks are not
        self._modes = ()  # of the gamepad that may drive
        self._seat_version = 0
        self._sat_at = 0.0
        self.seat = Seat(joysticks.send, self._on_lost)

    def add(self, sources, player):
        """sources: of what pages see, with prepare(), give() and handlers, by kind of message.
        player: the one that plays recordings.
        """
        self._sources, self._player = list(sources), player
        for source in self._sources:
            self._handlers.update(source.handlers)

    # ------------------------------------------------------------------ pages come and go

    def number(self):
        """A number for a new page."""
        self._next_number += 1
        return self._next_number - 1

    def join(self, client):
        """A page was opened."""
        self.clients[client.number] = client
        client.send(
            "hello",
            id=client.number,
            role=client.role,
            robots=sorted(self._graphs.graph.robots()),
            beat_ms=round(1000 * BEAT_S),
            pad={
                mode: {"axes": len(pad.axes), "buttons": pad.buttons} for mode, pad in F710.items()
            },
        )

    def leave(self, client):
        """A page was closed."""
        self.clients.pop(client.number, None)
        self._change(lambda: self.seat.gone(client.number))

    def hear(self, client, data):
        """A page has sent something."""
        now = time.monotonic()
        if not client.allows(now):
            client.refuse("messages", "too many in a second: some were dropped", now)
            return
        kind = "message"
        try:
            kind, fields = check_message(data)
            self._handlers[kind](client, now, **fields)
        except (ValueError, RefusedError) as error:
            client.refuse(kind, str(error), now)

    # ------------------------------------------------------------------------ what they say

    def _on_watch(self, client, _now, **fields):
        # All is told anew, but for the log, which the page has and which would stand there twice.
        goes_on = client.watch.log and fields["log"] and "log" in client.seen
        client.seen = {"log": client.seen["log"]} if goes_on else {}
        client.watch = Watch(**fields)

    def _on_drive(self, client, now, robot, mode):
        self.sit_down(client, robot, PAGE, now)
        self._modes = (mode,)

    def _on_leave(self, client, _now):
        self.stand_up(client)

    def _on_hand_over(self, client, now, to):
        other = self.clients.get(to)
        if other is None or not other.drives:
            raise RefusedError("that page is not there, or may not drive")
        self._change(lambda: self.seat.hand_over(client.number, to, now))
        self._modes = MODES  # the other hand may hold another gamepad
        self._sat_at = now

    def _on_input(self, client, now, *, axes, buttons, source, **more):
        client.must_drive()
        if client.number != self.seat.driver:
            return  # it was on its way when the seat was lost
        check_lengths(self._modes, axes, buttons)
        said = Input(axes=axes, buttons=buttons, **more)
        self._change(lambda: self.seat.input(client.number, said, now))

    def _on_release(self, client, _now, why):
        self._change(lambda: self.seat.release(client.number, why))

    # ----------------------------------------------------------------------------- the seat

    def sit_down(self, client, robot, how, now):
        """Let a client drive a robot. Raises RefusedError."""
        client.must_drive()
        if robot not in self._graphs.graph.robots():
            raise RefusedError(f"there is no robot {robot!r}")
        self._change(lambda: self.seat.take(client.number, robot, how, now))
        self._sat_at = now
        later(self._joysticks.advertise, robot)

    def stand_up(self, client):
        """The client drives no longer."""
        self._change(lambda: self.seat.leave(client.number))

    def lose(self, why):
        """Who drives is lost."""
        self._change(lambda: self.seat.lose(why))

    def _change(self, action):
        """Do something with the seat, of which all pages are told if it changes."""
        before = self.seat.state
        action()
        self._seat_version += self.seat.state != before

    def _on_lost(self, number, why):
        if number in self.clients:
            self.clients[number].send("lost", why=why)

    def _give_seat(self, client):
        if client.lacks("seat", self._seat_version):
            seat = self.seat
            driver = self.clients.get(seat.driver)
            client.send(
                "seat", driver=seat.driver, name=driver.name if driver else "", robot=seat.robot,
                how=seat.how, yours=seat.driver == client.number, armed=seat.armed, why=seat.why,
            )  # fmt: skip

    # ------------------------------------------------------------------------------- time

    def tick(self):
        """Time has passed."""
        now = time.monotonic()
        self._change(lambda: self.seat.tick(now))
        self._guard("the player of recordings", self._player.play, now)
        if not self._may_beat.ready(now):
            return
        self._beat(now)
        clients = list(self.clients.values())
        guard, named = self._guard, [(type(one).__name__, one) for one in self._sources]
        for name, source in named:
            guard(name, source.prepare, clients, now)
        for client in clients:
            if client.is_behind():
                continue  # it gets the newest once it has read
            guard("the seat", self._give_seat, client)
            for name, source in named:
                guard(name, source.give, client, now)

    def _beat(self, now):
        self._pads.driven = self.seat.robot if self.seat.driver is not None else None
        if self.seat.driver is None:
            return
        rival = self._pads.rival(self.seat.robot, self._sat_at)
        if rival:
            self._change(lambda: self.seat.free(f"{rival} drives this robot, too: end it first"))
            return
        driver = self.clients[self.seat.driver]
        self._beats += 1
        self.seat.beat(self._beats, now)
        if not driver.is_behind():
            driver.send("beat", n=self._beats, time=round(time.time(), 3), input=self.seat.newest)

    def end(self):
        """The robot at rest, then nothing."""
        self.seat.end()
