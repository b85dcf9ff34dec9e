"""Joins the pages with what they look at and what they drive. All of it runs in one thread."""

from __future__ import annotations

import itertools
import time
from collections import deque
from typing import Any, Callable, ClassVar, Sequence

from cockpit_server import limits, schema
from cockpit_server.clients import LOOKS_ONLY, Client, RefusedError, Source
from cockpit_server.driving.driver_session import DriverSession, Input
from cockpit_server.driving.words import NO_ROBOT, lost_text
from cockpit_server.feeds import OnceLater
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.guard import Guard
from cockpit_server.limits import SHARE, Budget
from gamepad.gamepads import F710
from node_kit.throttle import Throttle

BEAT_S = 0.05  # period of messages to the driver, and of robots to all pages
TICK_S = 0.01  # how often the session and a recording that plays look at the time
GIVE_S = 0.005  # each tick sends to pages for this long; the next tick serves the others
CONNECT_S = 2.0  # after which a node that is registered is not waited for any longer
RIVAL_S = 1.0  # another joystick that was heard within that has the first say


class Hub(Source):
    """The pages that are open, which of them drives, and what each is sent."""

    messages: ClassVar = {
        "drive": {"robot": schema.text, "mode": schema.one_of(*schema.MODES)},
        "stop": {},
        "hand_over": {"to": schema.whole},
        "input": schema.INPUT,
        "release": {"why": schema.text},
    }

    def __init__(
        self, soon: Callable[[Callable[[], Any]], Any], graph_watch: GraphWatch, joysticks: Any,
        pads: Any, report: Callable[[str], None],
    ) -> None:  # fmt: skip
        """soon: runs an action in this thread. report: reports a failure at once."""
        self._guard = Guard(report)
        self.soon, self._graphs, self._joysticks, self._pads = soon, graph_watch, joysticks, pads
        self._sources: tuple[Source, ...] = ()
        self.clients: dict[int, Client] = {}
        self._numbers, self._beats = itertools.count(1), 0
        self._messages = Budget(limits.ALL_BURST_S)  # all pages share it, except the driver
        self._requests: dict[str, Budget] = {}  # address -> of its HTTP requests
        self._due: deque[int] = deque()  # pages whose turn it is to be sent something
        self._may_beat = Throttle(1 / BEAT_S, burst=1.5)  # even, though the ticks are not
        self._modes: tuple[str, ...] = ()  # modes that the driving gamepad may have
        self._session_version = 0
        self._advertised: str | None = None  # the robot for which a joystick is to be advertised
        self._advertise = OnceLater(lambda: joysticks.keep(self._advertised))
        self._sat_at = 0.0
        self.session = DriverSession(joysticks.send, self._on_lost)

    def add(self, sources: Sequence[Source], player: Any) -> None:
        """Take in the sources and the player, the one that plays recordings."""
        self._player, self._sources = player, (self, *sources)
        self._schema = schema.Schema(self._sources)
        self._handlers = {schema.WATCH: self.on_watch}
        for one in self._sources:
            self._handlers.update({kind: getattr(one, f"on_{kind}") for kind in one.messages})

    def number(self) -> int:
        return next(self._numbers)

    def join(self, client: Client) -> None:
        self.clients[client.number] = client
        client.spoke_at = time.monotonic()
        client.watch = self._schema.watch()
        pads = {m: {"axes": len(pad.axes), "buttons": pad.buttons} for m, pad in F710.items()}
        client.send(
            "hello", id=client.number, role=client.role, beat_ms=round(1000 * BEAT_S), pad=pads,
            robots=sorted(self._graphs.graph.robots()),
        )  # fmt: skip

    def leave(self, client: Client) -> None:
        self.clients.pop(client.number, None)
        self._change(lambda: self.session.gone(client.number))

    def wait_s(self, client: Client) -> float:
        """Return how long [s] the next message of a page waits, for what the page has cost."""
        if client.number == self.session.driver:
            return 0.0
        now = time.monotonic()
        own = client.budget.wait_s(now, self._rate)
        wait_s = max(own, self._messages.wait_s(now, SHARE))
        client.budget.spend(limits.MESSAGE_S)
        self._messages.spend(limits.MESSAGE_S)
        return wait_s

    def request_wait_s(self, address: str) -> float:
        """Return how long [s] an HTTP request has to wait, for what its address has cost."""
        now, rate = time.monotonic(), SHARE / max(2, len(self._requests))
        if address not in self._requests:
            debts = self._requests.items()
            self._requests = {one: debt for one, debt in debts if debt.wait_s(now, rate)}
        own = self._requests.setdefault(address, Budget(limits.REQUESTS_BURST_S))
        wait_s = own.wait_s(now, rate)
        own.spend(limits.REQUEST_S)
        return wait_s

    @property
    def _rate(self) -> float:
        """The share of each page [s/s]."""
        return SHARE / max(1, len(self.clients))

    def hear(self, client: Client, data: Any) -> None:
        if client.number not in self.clients:
            return  # it waited, and is gone
        began_s, now = time.thread_time(), time.monotonic()
        client.spoke_at = now
        self._hear(client, data, now)
        cost_s = time.thread_time() - began_s
        client.budget.spend(cost_s)
        if client.number != self.session.driver:
            self._messages.spend(cost_s)

    def _hear(self, client: Client, data: Any, now: float) -> None:
        if not client.allows(now):
            client.refuse("messages", "too many messages in a second: some were dropped", now)
            return
        kind = "message"
        try:
            kind, fields = self._schema.check(data)
            self._handlers[kind](client, now, **fields)
        except (ValueError, RefusedError) as error:
            client.refuse(kind, str(error), now)

    def on_watch(self, client: Client, _now: float, **fields: Any) -> None:
        # What the page was sent it keeps, whichever tab it shows; a new connection is a new client.
        client.watch = self._schema.watch(**fields)

    def on_drive(self, client: Client, now: float, robot: str, mode: str) -> None:
        self.sit_down(client, robot, now)
        self._modes = (mode,)

    def on_stop(self, client: Client, _now: float) -> None:
        """Stop the driven robot: the own session is left, another page has to release all first."""
        client.must_drive()
        if client.number == self.session.driver:
            self.stand_up(client)
        else:
            self.lose(f"{client.name} pressed Stop")

    def on_hand_over(self, client: Client, now: float, to: int) -> None:
        other = self.clients.get(to)
        if other is None or not other.drives:
            raise RefusedError("that page is closed, or may not drive")
        self._change(lambda: self.session.hand_over(client.number, to, now))
        self._modes = schema.MODES  # the other hand may hold another gamepad
        self._sat_at = now

    def on_input(
        self, client: Client, now: float, *, axes: Any, buttons: Any, source: str, **more: Any
    ) -> None:
        client.must_drive()
        if client.number != self.session.driver:
            return  # it was on its way when the session was lost
        schema.check_lengths(self._modes, axes, buttons)
        said = Input(axes=axes, buttons=buttons, **more)
        may_arm = self.session.armed or self._is_heard(now)
        self._change(lambda: self.session.input(client.number, said, now, may_arm))

    def _is_heard(self, now: float) -> bool:
        """Return whether all subscribers of this joystick hear it; some may never answer."""
        listeners = self._graphs.joystick_listeners(self.session.robot)
        connected = listeners <= self._joysticks.listeners(self.session.robot)
        return connected or now - self._sat_at > CONNECT_S

    def on_release(self, client: Client, _now: float, why: str) -> None:
        self._change(lambda: self.session.release(client.number, why))

    def sit_down(self, client: Client, robot: str, now: float, *, plays: bool = False) -> None:
        """Let a client drive a robot. Raises RefusedError."""
        refusal = self.refusal(client, robot, now)
        if refusal:
            raise RefusedError(refusal)
        self._change(lambda: self.session.take(client.number, robot, now, plays=plays))
        self._sat_at = now

    def refusal(self, client: Client, robot: str, now: float) -> str:
        """Return why a page may not drive a robot now, or ""."""
        robots = self._graphs.graph.robots()
        if robot not in robots:
            return f"there is no robot {robot!r}" if robots else NO_ROBOT
        if not client.drives:
            return LOOKS_ONLY
        rival = self._pads.rival(robot, now - RIVAL_S)
        if rival and self.session.driver != client.number:
            return f"{rival} publishes the joystick topic of this robot: end it first"
        return self.session.refusal(client.number)

    def stand_up(self, client: Client) -> None:
        self._change(lambda: self.session.leave(client.number))

    def lose(self, why: str) -> None:
        self._change(lambda: self.session.lose(why))

    def _change(self, action: Callable[[], None]) -> None:
        """Change the session, and note the change for all pages."""
        before = self.session.state
        action()
        self._session_version += self.session.state != before
        if self.driven != self._advertised:
            self._advertised = self.driven
            self._advertise()

    @property
    def driven(self) -> str | None:
        """The robot that is driven from a page, or None."""
        return self.session.robot if self.session.driver is not None else None

    def _on_lost(self, number: int, why: str) -> None:
        if number in self.clients:
            keeps = number == self.session.driver
            again = keeps and not self.session.plays
            self.clients[number].send("lost", why=why, text=lost_text(why, keeps), again=again)

    def send_to(self, client: Client, now: float) -> None:
        """Send who drives."""
        if client.take_if_new("session", self._session_version):
            session = self.session
            name = self.clients[session.driver].name if session.driver in self.clients else ""
            client.send(
                "session", driver=session.driver, name=name, robot=session.robot,
                plays=session.plays, yours=session.driver == client.number, armed=session.armed,
            )  # fmt: skip

    def tick(self) -> None:
        now = time.monotonic()
        self._change(lambda: self.session.tick(now))
        self._guard("the player of recordings", self._player.play, now)
        if self._may_beat.ready(now):
            self._beat(now)
            clients = list(self.clients.values())
            self._each("collect", clients, now)
            waiting = set(self._due)
            self._due.extend(number for number in self.clients if number not in waiting)
        self._give(now)

    def _each(self, method: str, *arguments: Any) -> None:
        for source in self._sources:
            self._guard(type(source).__name__, getattr(source, method), *arguments)

    def _give(self, now: float) -> None:
        """Send what pages lack, one page after the other, for a while."""
        end_s = time.thread_time() + GIVE_S
        began_s = time.thread_time()
        while self._due and began_s < end_s:
            client = self.clients.get(self._due.popleft())
            # One that is behind gets the newest once it has read, one in debt when that is paid.
            if client is None or client.is_behind() or client.budget.wait_s(now, self._rate):
                continue
            self._each("send_to", client, now)
            ended_s = time.thread_time()
            client.budget.spend(ended_s - began_s)
            began_s = ended_s

    def _beat(self, now: float) -> None:
        self._pads.driven = self.driven
        if self.session.driver is None:
            return
        rival = self._pads.rival(self.session.robot, self._sat_at)
        if rival:
            self._change(lambda: self.session.free(f"{rival} also drives this robot: end it first"))
            return
        driver = self.clients[self.session.driver]
        self._beats += 1
        self.session.beat(self._beats, now)
        if not driver.is_behind():
            driver.send(
                "beat", n=self._beats, time=round(time.time(), 3), input=self.session.newest
            )
