"""Joins the pages with what they look at and what they drive. All of it runs in one thread."""

import time

from cockpit_server.clients import Watch
from cockpit_server.schema import check_lengths, check_message
from cockpit_server.seat import PAGE, Input, RefusedError, Seat
from cockpit_server.subscriptions import worker
from gamepad.gamepads import F710

BEAT_S = 0.05  # of the server to who drives, and of the robots to all
TICK_S = 0.025  # how often the seat looks at the time


class Hub:
    """The pages that are open, who of them drives, and what each is sent."""

    def __init__(self, graph_watch, robots, pads, joysticks, sources):
        """robots, pads, sources: have prepare() and give()."""
        self._graphs, self._robots, self._pads = graph_watch, robots, pads
        self._joysticks, self._sources = joysticks, sources
        self.clients = {}
        self._next_number, self._ticks, self._beats = 1, 0, 0
        self._mode = "D"
        self._seat_version = 0
        self._sat_at = 0.0
        self.seat = Seat(joysticks.send, self._on_lost)

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
            getattr(self, f"_on_{kind}")(client, now, **fields)
        except (ValueError, RefusedError) as error:
            client.refuse(kind, str(error), now)

    # ------------------------------------------------------------------------ what they say

    def _on_watch(self, client, _now, **fields):
        client.watch = Watch(**fields)
        client.seen.clear()

    def _on_drive(self, client, now, robot, mode):
        self._must_drive(client)
        if robot not in self._graphs.graph.robots():
            raise RefusedError(f"there is no robot {robot!r}")
        self._change(lambda: self.seat.take(client.number, robot, PAGE, now))
        self._mode, self._sat_at = mode, now
        worker.submit(self._joysticks.advertise, robot)

    def _on_leave(self, client, _now):
        self._change(lambda: self.seat.leave(client.number))

    def _on_hand_over(self, client, now, to):
        other = self.clients.get(to)
        if other is None or not other.drives:
            raise RefusedError("that page is not there, or may not drive")
        self._change(lambda: self.seat.hand_over(client.number, to, now))
        self._sat_at = now

    def _on_input(self, client, now, n, t, beat, axes, buttons, pad, source):
        if client.number != self.seat.driver:
            raise RefusedError("this page does not drive")
        check_lengths(self._mode, axes, buttons)
        said = Input(n, t / 1000, beat, axes, buttons, pad)
        self._change(lambda: self.seat.input(client.number, said, now))

    def _on_release(self, client, _now, why):
        self._change(lambda: self.seat.release(client.number, why))

    def _must_drive(self, client):
        if not client.drives:
            raise RefusedError("this page was opened with the viewers' token: it may only look")

    # ----------------------------------------------------------------------------- the seat

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
        self._ticks += 1
        if self._ticks % round(BEAT_S / TICK_S):
            return
        self._beat(now)
        clients = list(self.clients.values())
        robots_known = self._graphs.graph.robots_with_odometry()
        driven = self.seat.robot if self.seat.driver is not None else None
        self._robots.prepare(clients, robots_known, now)
        self._pads.prepare(clients, driven, now)
        for source in self._sources:
            source.prepare(clients, now)
        for client in clients:
            if client.is_behind():
                continue  # it gets the newest once it has read
            self._give_seat(client)
            for source in (self._robots, self._pads, *self._sources):
                source.give(client, now)

    def _beat(self, now):
        if self.seat.driver is None:
            return
        rival = self._pads.rival(self.seat.robot, self._sat_at)
        if rival:
            self._change(lambda: self.seat.free(f"{rival} drives this robot, too: end it first"))
            return
        driver = self.clients.get(self.seat.driver)
        self._beats += 1
        self.seat.beat(self._beats, now)
        if driver and not driver.is_behind():
            driver.send("beat", n=self._beats, time=round(time.time(), 3), input=self.seat.newest)

    def end(self):
        """The robot at rest, then nothing."""
        self.seat.end()
