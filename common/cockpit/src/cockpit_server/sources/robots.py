"""The robots: where they are, by their odometry, and the commands for the parts of a Kobuki."""

from __future__ import annotations

import time
from math import isfinite
from typing import Any, ClassVar, Sequence

from nav_msgs.msg import Odometry

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.feeds import Feeds, Raw, read
from cockpit_server.graph import topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.motion import Motion, covered, is_somewhere, motion
from cockpit_server.schema import switch

DIGITS = 4  # after the point [m]: a tenth of a millimetre
KOBUKI = {  # what a robot's commands of these types ask for, by their value
    "kobuki_msgs/Led": ("off", "green", "orange", "red"),
    "kobuki_msgs/Sound": (
        "on", "off", "recharge", "button", "error", "cleaningstart", "cleaningend",
    ),
}  # fmt: skip
COMMANDS = "/mobile_base/commands/"
FRESH_S, LEAST_SPEED = 1.0, 0.01  # [s], [m/s, rad/s]: newer and faster odometry is motion


class Robots(Source):
    """The robots' names, and the newest odometry of each, for all pages that show them."""

    watches: ClassVar = {"robots": (switch, False)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._newest: dict[str, tuple[bytes, float]] = {}  # topic -> (bytes, when they came [s])
        # robot -> (Motion, when it came [s], distance covered [m])
        self._states: dict[str, tuple[Motion, float, float]] = {}
        self._text = ""  # all robots, as pages get them
        self._kobukis: dict[str, dict[str, str]] = {}  # robot -> {led1, led2, sound: name}

    def collect(self, clients: Sequence[Client], now: float) -> None:
        # Also while no page looks: an LED keeps its colour.
        types = self._graphs.graph.types
        commands = [topic for topic, kind in types.items() if kind in KOBUKI and COMMANDS in topic]
        named = {topic.partition(COMMANDS)[0].strip("/") for topic in commands}
        self._kobukis = {r: parts for r, parts in list(self._kobukis.items()) if r in named}
        self._feeds.set_subscriptions(
            (self, "kobuki"), dict.fromkeys(commands, self._hear_command), every=True
        )
        watched = any(client.watch.robots for client in clients)
        known = self._graphs.graph.robots_with_odometry() if watched else ()
        topics = {topic_of(robot, "odom"): robot for robot in known}
        self._feeds.set_subscriptions(self, dict.fromkeys(topics, self._hear), every=False)
        if not watched:
            self._states, self._text = {}, ""
            return
        for topic, robot in topics.items():
            self._read(topic, robot)
        robots = {r: shown(*state, now) for r, state in self._states.items() if r in known}
        for robot in robots.keys() & self._kobukis.keys():
            robots[robot].update(self._kobukis[robot])
        self._text = encoded("robots", robots=robots)

    def send_to(self, client: Client, now: float) -> None:
        if not client.watch.robots:
            return
        names = sorted(self._graphs.graph.robots())
        if client.take_if_new("names", names):
            client.send("names", names=names)
        if self._text:
            client.write(self._text)  # also while all stand: it shows that the server is there

    def moves(self, robot: str, now: float) -> bool:
        """Return whether the newest odometry says so; known while a page shows robots."""
        state, came, _ = self._states.get(robot, (Motion(0, 0, 0, 0, 0), 0.0, 0.0))
        return now - came < FRESH_S and max(abs(state.v), abs(state.w)) > LEAST_SPEED

    def _hear(self, message: Raw, topic: str) -> None:
        self._newest[topic] = (message.data, time.monotonic())

    def _hear_command(self, message: Raw, topic: str) -> None:
        robot, _, part = topic.partition(COMMANDS)
        names = KOBUKI.get(self._graphs.graph.types.get(topic, ""), ())
        if len(message.data) == 1 and message.data[0] < len(names):
            self._kobukis.setdefault(robot.strip("/"), {})[part] = names[message.data[0]]

    def _read(self, topic: str, robot: str) -> None:
        data, came = self._newest.pop(topic, (b"", 0.0))
        odometry = read(Odometry, data)
        if odometry is None:  # nothing new, or malformed
            return
        new = motion(odometry)
        last, _, so_far = self._states.get(robot, (new, 0.0, 0.0))
        self._states[robot] = (new, came, covered(last, new, so_far))


def shown(state: Motion, came: float, way: float, now: float) -> dict[str, Any]:
    """Return a robot's finite values as pages get them, its age in whole seconds."""
    values = {**state._asdict(), "covered": way, "age": max(0, int(now - came))}
    if not is_somewhere(state):
        for name in ("x", "y", "yaw"):
            del values[name]
    return {name: round(value, DIGITS) for name, value in values.items() if isfinite(value)}
