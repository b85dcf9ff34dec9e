"""Who drives a robot: the one object that decides it and says why a robot stands."""

from __future__ import annotations

from typing import Any, Callable, ClassVar, Mapping, Protocol, Sequence

from cockpit_server import schema
from cockpit_server.driving import reasons
from cockpit_server.driving.driver_session import Axes, Buttons, DriverSession, PageInput
from cockpit_server.driving.joy2twist_reports import Joy2TwistReports
from cockpit_server.driving.player import Player
from cockpit_server.driving.reasons import About
from cockpit_server.errors import RefusedError
from cockpit_server.graph import GraphWatcher, topic_of
from cockpit_server.pages import LOOKS_ONLY, Page, TabSource

CONNECT_S = 2.0  # how long to wait for the connection of a node that is registered
RIVAL_S = 1.0  # A joystick that published within this time takes precedence over a page.


class JoystickTopics(Protocol):
    """The topics joy of all robots: see ros/joysticks.py."""

    def advertise(self, robot: str | None) -> None: ...
    def send(self, robot: str, axes: Axes, buttons: Buttons) -> None: ...
    def is_connected(self, robot: str) -> bool: ...
    def rival(self, robot: str, since: float) -> str: ...


class Driving(TabSource):
    """The session, its joystick, the recording that plays, and what drives the other robots."""

    messages: ClassVar = {
        "drive": {"robot": schema.text, "mode": schema.one_of(*schema.MODES)},
        "stop": {},
        "hand_over": {"to": schema.whole},
        "input": schema.INPUT,
        "release": {"why": schema.text},
    }

    def __init__(
        self, pages: Mapping[int, Page], graphs: GraphWatcher, joysticks: JoystickTopics,
        reports: Joy2TwistReports, moves: Callable[[str, float], bool],
    ) -> None:  # fmt: skip
        """pages: the open ones. moves: whether the odometry of a robot shows motion at a time."""
        self._pages, self._graphs, self._joysticks = pages, graphs, joysticks
        self._reports, self._moves = reports, moves
        self.session = DriverSession(joysticks.send, self._on_lost)
        self._player: Player | None = None  # the last one that played, or still plays
        self._modes: tuple[str, ...] = ()  # modes that the driving gamepad may have
        self._began_at = 0.0  # [s] when the session began
        self._beats = 0
        self._changes = 0  # changes of the driver, and losses
        self._abouts: dict[str, About] = {}  # by robot
        self._rows: dict[str, dict[str, str]] = {}  # by robot: its row in the table
        self._driven: str | None = None  # at the last collect()

    @property
    def driven(self) -> str | None:
        """The robot that is driven from a page, or None."""
        return self.session.robot if self.session.driver is not None else None

    def is_driver(self, page: Page) -> bool:
        return page.number == self.session.driver

    def on_drive(self, page: Page, now: float, robot: str, mode: str) -> None:
        self._take(page, robot, now)
        self._modes = (mode,)

    def play(
        self, page: Page, player: Player, now: float, *, robot: str = "", topic: str = ""
    ) -> None:
        """Let a page play a recording, in the place of a robot's joystick or on a topic.

        Raises RefusedError.
        """
        if topic:
            self.must_be_free(page)
            robot = self._graphs.graph.robot_with(topic)
            self.session.take(page.number, robot, now, plays=True, topic=topic, rest=player.end)
            self._begin(now)
        else:
            self._take(page, robot, now, plays=True, rest=player.end)
        self._player = player

    def plays(self, player: Player | None) -> bool:
        """Return whether this player is playing."""
        return player is not None and player is self._player and self.session.plays

    def publish(self, page: Page, topic: str, rest: Callable[[], object], now: float) -> None:
        """Let a page drive by a form. rest: publishes the message that ends its motion.

        Raises RefusedError.
        """
        self.must_be_free(page)
        robot = self._graphs.graph.robot_with(topic)
        self.session.publish(page.number, robot, topic, rest, now)
        self._begin(now)

    def publishes(self, page: Page, topic: str) -> bool:
        """Return whether a page drives by a form on a topic."""
        session = self.session
        return self.is_driver(page) and session.topic == topic and not session.plays

    def _take(self, page: Page, robot: str, now: float, **recording: Any) -> None:
        refusal = self.refusal(page, robot, now)
        if refusal:
            raise RefusedError(refusal)
        self.session.take(page.number, robot, now, **recording)
        self._begin(now)

    def _begin(self, now: float) -> None:
        self._changes += 1
        self._began_at = now

    def refusal(self, page: Page, robot: str, now: float) -> str:
        """Return why a page may not drive a robot now, or ""."""
        graph = self._graphs.graph
        robots = graph.robots()
        if not robots:
            return reasons.TURTLES if graph.turtlesims() else reasons.NO_ROBOT
        if robot not in robots:
            return f"there is no robot {robot!r}"
        if not page.drives:
            return LOOKS_ONLY
        rival = self._joysticks.rival(robot, now - RIVAL_S)
        if rival and not self.is_driver(page):
            return reasons.rival(rival, graph.services)
        return self.session.refusal(page.number)

    def on_stop(self, page: Page, _now: float) -> None:
        """Stop the driven robot; the session of another page stays, but must be armed again."""
        page.must_drive()
        if self.is_driver(page):
            self.leave(page)
        else:
            self.session.lose(f"{page.name} pressed Stop")

    def leave(self, page: Page) -> None:
        """End driving from this page."""
        self.session.leave(page.number)

    def gone(self, page: Page) -> None:
        """End the session of a page that is closed."""
        self.session.gone(page.number)

    def on_hand_over(self, page: Page, now: float, to: int) -> None:
        other = self._pages.get(to)
        if other is None or not other.drives:
            raise RefusedError("that page is closed, or may not drive")
        self.session.hand_over(page.number, to, now)
        self._modes = schema.MODES  # the other hand may hold another gamepad
        self._begin(now)

    def on_input(
        self, page: Page, now: float, *, axes: Any, buttons: Any, source: str, **more: Any
    ) -> None:
        page.must_drive()
        if not self.is_driver(page):
            return  # It was sent before the page knew that its session had ended.
        schema.check_lengths(self._modes, axes, buttons)
        message = PageInput(axes=axes, buttons=buttons, **more)
        is_late = now - self._began_at > CONNECT_S  # Some subscribers never connect.
        is_connected = is_late or self._joysticks.is_connected(self.session.robot)
        self.session.input(page.number, message, now, self.session.armed or is_connected)

    def on_release(self, page: Page, _now: float, why: str) -> None:
        self.session.release(page.number, why)

    def must_be_free(self, page: Page) -> None:
        """Raise RefusedError if a page is a viewer's, or another page drives."""
        refusal = self.why_not_free(page)
        if refusal:
            raise RefusedError(refusal)

    def why_not_free(self, page: Page) -> str:
        """Return why a page may not act on the graph now, or ""."""
        if not page.drives:
            return LOOKS_ONLY
        is_free = self.session.driver in (None, page.number)
        return "" if is_free else "another page drives: until it ends, only that page may do this"

    def must_rest(self, page: Page, robot: str) -> None:
        """Raise RefusedError if a page may not reset a robot, or something else drives it."""
        page.must_drive()
        if robot == self.driven and not self.is_driver(page):
            raise RefusedError("another page drives this robot: only that page may reset it")
        about = self._abouts.get(robot, About())
        if about.is_driven_by_node:
            node = reasons.driver(about)
            raise RefusedError(f"{node} drives this robot: stop it before you reset the robot")

    def tick(self, now: float) -> None:
        """Check for a silent page, and publish what is due of a recording; call every 10 ms."""
        self.session.tick(now)
        self._joysticks.advertise(None if self.session.topic else self.driven)
        player, number = self._player, self.session.driver
        if player is None or number is None or not self.plays(player):
            return
        for send, data in player.due(now):
            send(data)
        if player.is_over(now):
            self.session.leave(number)
        elif self._pages[number].is_cut():
            self.session.lose("the network to the page that plays is down")

    def beat(self, now: float) -> None:
        """Send the driver a beat, unless another node drives; call every 50 ms."""
        if self.session.driver is None:
            return
        rival = self._joysticks.rival(self.session.robot, self._began_at)
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
            is_kept_by_hand = keeps and self.session.is_by_hand
            about = self._abouts.get(self.session.robot, About())
            todo = reasons.again(about) if is_kept_by_hand else ""
            text = f"{reasons.lost_text(why, keeps)} {todo}".strip()
            self._pages[number].send("lost", text=text, keeps=is_kept_by_hand)

    def collect(self, pages: Sequence[Page], now: float) -> None:
        if self._driven not in (None, self.driven):
            self._reports.outdate(self._driven)  # Its driver has left since.
        self._driven = self.driven
        self._abouts = {robot: self._about(robot, now) for robot in self._graphs.graph.robots()}
        for robot, about in self._abouts.items():
            if about.is_driven_by_node:
                self.session.moves_on(robot)
        self._rows = {robot: reasons.row(about) for robot, about in self._abouts.items()}

    def _about(self, robot: str, now: float) -> About:
        session, graph = self.session, self._graphs.graph
        page = self._pages.get(session.driver or 0) if robot == self.driven else None
        return About(
            driver=page.number if page else None,
            name=page.name if page else "",
            plays=bool(page) and session.plays,
            topic=session.topic if page else "",
            armed=bool(page) and session.armed,
            pushes=bool(page) and session.pushes,
            why=session.why if robot == session.stopped else "",
            report=self._reports.newest(robot, now),
            publishers=graph.joysticks(robot),
            moves=self._moves(robot, now),
            has_subscriber=bool(graph.joystick_subscribers(robot)),
            has_mux=topic_of(robot, reasons.MUX_INPUT) in graph.subscribers,
            no_reset=graph.why_no_reset(robot),
        )

    def send_to(self, page: Page, now: float) -> None:
        """Send which page drives, and what drives the robot in sight."""
        session = self.session
        if page.take_if_new("session", (session.state, self._changes)):
            page.send(
                "session", driver=session.driver, robot=session.robot, plays=session.plays,
                topic=session.topic, yours=self.is_driver(page), armed=session.armed,
            )  # fmt: skip
        robot = page.watch.look or ""
        about = self._abouts.get(robot, About())
        refusal = self.refusal(page, robot, now)
        texts = {
            "who": self._who(about, robot, page),
            "ready": reasons.ready(about, robot, page.number, refusal),
            "how": reasons.how_to(about, page.number, not refusal),
            "refusal": reasons.sentence(refusal),
            "no_reset": reasons.sentence(about.no_reset),
            "robots": self._rows,
        }
        if page.take_if_new("drives", texts):
            page.send("drives", **texts)

    def _who(self, about: About, robot: str, page: Page) -> str:
        """Return what drives the robot in sight, and which page publishes on a topic."""
        who, session = reasons.who(about, robot, page.number), self.session
        if session.driver is None or not session.topic or about.driver is not None:
            return who
        name, is_own = self._pages[session.driver].name, self.is_driver(page)
        how = reasons.on_topic(name, is_own, session.topic, session.plays)
        return f"{how} {who}" if about.is_driven_by_node else how
