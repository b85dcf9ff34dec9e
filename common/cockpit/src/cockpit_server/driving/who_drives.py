"""Who drives each robot: the one object that decides it, and says why a robot stands (pure)."""

from __future__ import annotations

from typing import Any, Callable, ClassVar, Mapping, Sequence

from cockpit_server import schema
from cockpit_server.clients import LOOKS_ONLY, Client, RefusedError, Source
from cockpit_server.driving import reasons
from cockpit_server.driving.driver_session import DriverSession, Input
from cockpit_server.driving.player import Player
from cockpit_server.driving.reasons import About
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.ros.joysticks import Joysticks
from cockpit_server.ros.teleop import Teleop

CONNECT_S = 2.0  # after which a node that is registered is not waited for any longer
RIVAL_S = 1.0  # another joystick that was heard within that has the first say


class Driving(Source):
    """The session, its joystick, and the recording that plays; what drives the other robots."""

    messages: ClassVar = {
        "drive": {"robot": schema.text, "mode": schema.one_of(*schema.MODES)},
        "stop": {},
        "hand_over": {"to": schema.whole},
        "input": schema.INPUT,
        "release": {"why": schema.text},
    }

    def __init__(
        self, pages: Mapping[int, Client], graph_watch: GraphWatch, joysticks: Joysticks,
        teleop: Teleop, moves: Callable[[str, float], bool],
    ) -> None:  # fmt: skip
        """pages: those that are open. moves: whether a robot moves, by its odometry, at a time."""
        self._pages, self._graphs, self._joysticks = pages, graph_watch, joysticks
        self._teleop, self._moves = teleop, moves
        self.session = DriverSession(joysticks.send, self._on_lost)
        self._player: Player | None = None  # It plays a recording, or was the last one.
        self._modes: tuple[str, ...] = ()  # modes that the driving gamepad may have
        self._sat_at = 0.0
        self._beats = 0
        self._changes = 0  # who drives, and losses
        self._abouts: dict[str, About] = {}
        self._robots: dict[str, dict[str, str]] = {}  # what drives each, and joy2twist's report
        self._driven: str | None = None  # the last time

    @property
    def driven(self) -> str | None:
        """The robot that is driven from a page, or None."""
        return self.session.robot if self.session.driver is not None else None

    def is_driver(self, client: Client) -> bool:
        return client.number == self.session.driver

    def on_drive(self, client: Client, now: float, robot: str, mode: str) -> None:
        self._sit_down(client, robot, now)
        self._modes = (mode,)

    def play(self, client: Client, robot: str, player: Player, now: float) -> None:
        """Let a client play a recording to a robot. Raises RefusedError."""
        self._sit_down(client, robot, now, plays=True)
        self._player = player

    def plays(self, player: Player | None) -> bool:
        """Return whether this is what is played now."""
        return player is not None and player is self._player and self.session.plays

    def publish(self, client: Client, topic: str, rest: Callable[[], object], now: float) -> None:
        """Let a client drive by a form. rest: publishes what ends its motion.

        Raises RefusedError.
        """
        self.must_be_free(client)
        robot = self._graphs.graph.robot_with(topic)
        self.session.publish(client.number, robot, topic, rest, now)
        self._begin(now)

    def publishes(self, client: Client, topic: str) -> bool:
        """Return whether a client drives by a form on a topic."""
        return self.is_driver(client) and self.session.topic == topic

    def _sit_down(self, client: Client, robot: str, now: float, plays: bool = False) -> None:
        refusal = self.refusal(client, robot, now)
        if refusal:
            raise RefusedError(refusal)
        self.session.take(client.number, robot, now, plays=plays)
        self._begin(now)

    def _begin(self, now: float) -> None:
        self._changes += 1
        self._sat_at = now

    def refusal(self, client: Client, robot: str, now: float) -> str:
        """Return why a page may not drive a robot now, or ""."""
        graph = self._graphs.graph
        robots = graph.robots()
        if not robots:
            return reasons.TURTLES if graph.turtlesims() else reasons.NO_ROBOT
        if robot not in robots:
            return f"there is no robot {robot!r}"
        if not client.drives:
            return LOOKS_ONLY
        rival = self._joysticks.rival(robot, now - RIVAL_S)
        if rival and not self.is_driver(client):
            return reasons.rival(rival, graph.services)
        return self.session.refusal(client.number)

    def on_stop(self, client: Client, _now: float) -> None:
        """Stop the driven robot: the own session is left, another page has to release all first."""
        client.must_drive()
        if self.is_driver(client):
            self.leave(client)
        else:
            self.session.lose(f"{client.name} pressed Stop")

    def leave(self, client: Client) -> None:
        """End driving from this page."""
        self.session.leave(client.number)

    def gone(self, client: Client) -> None:
        """Take note that a page is closed."""
        self.session.gone(client.number)

    def on_hand_over(self, client: Client, now: float, to: int) -> None:
        other = self._pages.get(to)
        if other is None or not other.drives:
            raise RefusedError("that page is closed, or may not drive")
        self.session.hand_over(client.number, to, now)
        self._modes = schema.MODES  # the other hand may hold another gamepad
        self._begin(now)

    def on_input(
        self, client: Client, now: float, *, axes: Any, buttons: Any, source: str, **more: Any
    ) -> None:
        client.must_drive()
        if not self.is_driver(client):
            return  # it was on its way when the session was lost
        schema.check_lengths(self._modes, axes, buttons)
        said = Input(axes=axes, buttons=buttons, **more)
        # All subscribers of this joystick are connected; some may never answer.
        is_heard = self._joysticks.is_heard(self.session.robot) or now - self._sat_at > CONNECT_S
        self.session.input(client.number, said, now, self.session.armed or is_heard)

    def on_release(self, client: Client, _now: float, why: str) -> None:
        self.session.release(client.number, why)

    def must_be_free(self, client: Client) -> None:
        """Raise RefusedError if a page only looks, or another one drives."""
        client.must_drive()
        if self.session.driver not in (None, client.number):
            raise RefusedError("another page drives: until it ends, only that page may do this")

    def must_rest(self, client: Client, robot: str) -> None:
        """Raise RefusedError if a page may not reset a robot, which something else drives."""
        client.must_drive()
        if robot == self.driven and not self.is_driver(client):
            raise RefusedError("another page drives this robot: only that page may reset it")
        about = self._abouts.get(robot, About())
        if about.is_driven_by_node:
            node = reasons.driver(about)
            raise RefusedError(f"{node} drives this robot: stop it before you reset the robot")

    def tick(self, now: float) -> None:
        """Notice what has not come, and publish what is due of a recording; call every 10 ms."""
        self.session.tick(now)
        self._joysticks.advertise(None if self.session.topic else self.driven)
        player, number = self._player, self.session.driver
        if player is None or number is None or not self.plays(player):
            return
        for axes, buttons in player.due(now):
            self.session.play(axes, buttons)
        if player.is_over(now):
            self.session.leave(number)
        elif self._pages[number].is_cut():
            self.session.lose("the network to the page that plays is down")

    def beat(self, now: float) -> None:
        """Send the driver a beat, if no other node drives; call every 50 ms."""
        if self.session.driver is None:
            return
        rival = self._joysticks.rival(self.session.robot, self._sat_at)
        if rival and not self.session.topic:
            self.session.free(reasons.rival(rival, self._graphs.graph.services))
            return
        self._beats += 1
        self.session.beat(self._beats, now)
        page = self._pages[self.session.driver]
        if not page.is_behind():
            page.send("beat", n=self._beats)

    def _on_lost(self, number: int, why: str) -> None:
        self._changes += 1
        if number in self._pages:
            keeps = number == self.session.driver
            may_go_on = keeps and self.session.is_by_hand
            todo = reasons.again(self._abouts.get(self.session.robot, About())) if may_go_on else ""
            text = f"{reasons.lost_text(why, keeps)} {todo}".strip()
            self._pages[number].send("lost", text=text, keeps=may_go_on)

    def collect(self, clients: Sequence[Client], now: float) -> None:
        if self._driven not in (None, self.driven):
            self._teleop.outdate(self._driven)  # Its driver has left since.
        self._driven = self.driven
        self._abouts = {robot: self._about(robot, now) for robot in self._graphs.graph.robots()}
        for robot, about in self._abouts.items():
            if about.is_driven_by_node:
                self.session.moves_on(robot)
        self._robots = {robot: reasons.in_a_table(about) for robot, about in self._abouts.items()}

    def _about(self, robot: str, now: float) -> About:
        session = self.session
        page = self._pages.get(session.driver or 0) if robot == self.driven else None
        return About(
            driver=page.number if page else None,
            name=page.name if page else "",
            plays=bool(page) and session.plays,
            topic=session.topic if page else "",
            armed=bool(page) and session.armed,
            pushes=bool(page) and session.pushes,
            why=session.why if robot == session.stopped else "",
            said=self._teleop.newest(robot, now),
            senders=self._graphs.joysticks(robot),
            moves=self._moves(robot, now),
            is_heard=bool(self._graphs.joystick_listeners(robot)),
            no_reset=self._graphs.graph.why_no_reset(robot),
        )

    def send_to(self, client: Client, now: float) -> None:
        """Send which page drives, and of the robot in sight what drives it."""
        session = self.session
        if client.take_if_new("session", (session.state, self._changes)):
            client.send(
                "session", driver=session.driver, robot=session.robot, plays=session.plays,
                topic=session.topic, yours=self.is_driver(client), armed=session.armed,
            )  # fmt: skip
        robot = client.watch.look or ""
        about = self._abouts.get(robot, About())
        refusal = self.refusal(client, robot, now)
        said = {
            "who": self._who(about, robot, client),
            "ready": reasons.ready(about, robot, client.number, refusal),
            "how": reasons.how_to(about, client.number, not refusal),
            "refusal": reasons.sentence(refusal),
            "no_reset": reasons.sentence(about.no_reset),
            "robots": self._robots,
        }
        if client.take_if_new("drives", said):
            client.send("drives", **said)

    def _who(self, about: About, robot: str, client: Client) -> str:
        """Return what drives the robot in sight, and whose form drives, which may be any robot."""
        who, driver = reasons.who(about, robot, client.number), self.session.driver
        if driver is None or not self.session.topic or about.driver is not None:
            return who
        form = reasons.by_form(self._pages[driver].name, self.is_driver(client), self.session.topic)
        return f"{form} {who}" if about.is_driven_by_node else form
