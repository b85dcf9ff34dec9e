"""The robots: where they are, by their odometry, and what moves them, by their joystick."""

from __future__ import annotations

import time
from math import isfinite
from typing import Any, ClassVar, Sequence

from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.feeds import Feeds, read
from cockpit_server.graph import topic_of
from cockpit_server.graph_watch import GraphWatch
from cockpit_server.motion import Motion, covered, is_somewhere, motion
from cockpit_server.schema import or_null, switch, text
from node_kit.rospy_patches.connections import sender_of

DIGITS = 4  # after the point [m]: a tenth of a millimetre
LONGEST_JOY = 4000  # bytes; a gamepad's message has some 100, a huge one would hold up the driver
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
        self._beat = 0
        self._shown: dict[str, dict[str, Any]] = {}  # robot -> its state as pages get it
        self._changed: dict[str, int] = {}  # robot -> the beat in which that changed last
        self._began = 0  # the beat in which a robot came or went last
        self._texts: dict[int, str] = {}  # the last beat of which a page knows -> what it lacks
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
            self._states = {}
            return
        self._beat, self._texts = self._beat + 1, {}
        for topic, robot in topics.items():
            self._read(topic, robot)
        robots = {r: shown(*state, now) for r, state in self._states.items() if r in known}
        for robot in robots.keys() & self._kobukis.keys():
            robots[robot].update(self._kobukis[robot])
        if robots.keys() != self._shown.keys():
            self._began = self._beat
        changed = [r for r, state in robots.items() if state != self._shown.get(r)]
        self._changed.update(dict.fromkeys(changed, self._beat))
        self._shown = robots

    def send_to(self, client: Client, now: float) -> None:
        if not client.watch.robots:
            return
        names = sorted(self._graphs.graph.robots())
        if client.take_if_new("names", names):
            client.send("names", names=names)
        last, client.seen["robots"] = client.seen.get("robots", -1), self._beat
        if last not in self._texts:
            self._texts[last] = self._text_since(last)
        client.write(self._texts[last])

    def _text_since(self, last: int) -> str:
        """Return all robots, or only those that changed since a beat, if none came or went."""
        everything = last < self._began
        robots = {r: s for r, s in self._shown.items() if everything or self._changed[r] > last}
        return encoded("robots", stamp=round(time.time(), 3), all=everything, robots=robots)

    def moves(self, robot: str, now: float) -> bool:
        """Return whether the newest odometry says so; known while a page shows robots."""
        state, came, _ = self._states.get(robot, (Motion(0, 0, 0, 0, 0), 0.0, 0.0))
        return now - came < FRESH_S and max(abs(state.v), abs(state.w)) > LEAST_SPEED

    def _hear(self, message: Any, topic: str) -> None:
        self._newest[topic] = (message.data, time.monotonic())

    def _hear_command(self, message: Any, topic: str) -> None:
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


def joy_shown(data: bytes) -> dict[str, Any] | None:
    """Return {axes, buttons} of the bytes of a Joy, or None if malformed or too long."""
    joy = read(Joy, data, LONGEST_JOY)
    if joy is None:
        return None
    axes = [round(value, DIGITS) if isfinite(value) else 0.0 for value in joy.axes]
    return {"axes": axes, "buttons": list(joy.buttons)}


class Pads(Source):
    """The newest joystick message of each robot that a page shows or drives."""

    watches: ClassVar = {"look": (or_null(text), None)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch, own_name: str) -> None:
        self._feeds, self._graphs, self._own_name = feeds, graph_watch, own_name
        self.driven: str | None = None  # the robot that is driven from a page
        # topic -> (when its newest message came [s], what pages get of it)
        self._newest: dict[str, tuple[float, dict[str, Any] | None]] = {}
        self._rivals: dict[str, tuple[str, float]] = {}  # topic -> (node, newest message [s])

    def collect(self, clients: Sequence[Client], now: float) -> None:
        looked_at = {client.watch.look for client in clients} & self._graphs.graph.robots()
        robots = {robot for robot in (*looked_at, self.driven) if robot is not None}
        handlers = {topic_of(robot, "joy"): self._hear for robot in robots}
        self._feeds.set_subscriptions(self, handlers, every=False)
        self._newest = {topic: self._newest[topic] for topic in handlers if topic in self._newest}
        self._rivals = {topic: self._rivals[topic] for topic in handlers if topic in self._rivals}

    def send_to(self, client: Client, now: float) -> None:
        robot = client.watch.look
        came, joy = self._newest.get(topic_of(robot or "", "joy"), (0.0, None))
        if client.take_if_new("pad", (robot, came)) and joy:
            client.send("pad", robot=robot, age=round(max(0.0, now - came), 3), **joy)

    def rival(self, robot: str, since: float) -> str | None:
        """Return the other node that sent on the robot's topic since a time [s], or None."""
        name, sent = self._rivals.get(topic_of(robot, "joy"), ("", 0.0))
        return name if sent >= since and name else None

    def _hear(self, message: Any, topic: str) -> None:
        now, sender = time.monotonic(), sender_of(message)
        if sender != self._own_name:
            self._rivals[topic] = (sender, now)
        self._newest[topic] = (now, joy_shown(message.data))
