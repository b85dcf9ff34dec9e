"""The robots: where they are, and what is known of the parts of a Kobuki."""

from __future__ import annotations

import time
from math import isfinite
from typing import Any, ClassVar, Sequence

from kobuki_msgs.msg import SensorState
from nav_msgs.msg import Odometry

from cockpit_server.clients import Client, Source, encoded
from cockpit_server.graph import ODOMETRY, topic_of
from cockpit_server.kobuki import core_shown
from cockpit_server.motion import FARTHEST_M, Motion, covered, motion
from cockpit_server.ros.feeds import Feeds, Raw, read
from cockpit_server.ros.graph_watch import GraphWatch
from cockpit_server.schema import switch

DIGITS = 4  # after the point [m]: a tenth of a millimetre
KOBUKI = {  # what a robot's commands of these types ask for, by their value
    "kobuki_msgs/BumperEvent": (),
    "kobuki_msgs/Led": ("off", "green", "orange", "red"),
    "kobuki_msgs/Sound": (
        "on", "off", "recharge", "button", "error", "cleaningstart", "cleaningend",
    ),
}  # fmt: skip
BASE, BUMPER, TRUTH = "/mobile_base/", "events/bumper", "base_pose_ground_truth"
CORE, CORE_TYPE = "mobile_base/sensors/core", "kobuki_msgs/SensorState"
BUMPERS, BUMPER_BYTES = 3, 2  # bytes of an event: which bumper, and whether it is pressed
SPEED, SPEED_S = ("v", "w", "age"), 0.25  # How often these are sent to a page without the floor.
CORE_FRESH_S = 2.0  # older values of its sensors are not shown
FRESH_S, LEAST_SPEED = 1.0, 0.01  # [s], [m/s, rad/s]: newer and faster odometry is motion


class Robots(Source):
    """All robots, with the newest odometry of each, for the pages that show them."""

    # floor: all about them, twenty times a second; else the speed of the one it looks at
    watches: ClassVar = {"robots": (switch, False), "floor": (switch, False)}

    def __init__(self, feeds: Feeds, graph_watch: GraphWatch) -> None:
        self._feeds, self._graphs = feeds, graph_watch
        self._newest: dict[str, tuple[bytes, float]] = {}  # topic -> (bytes, when they came [s])
        # robot -> (Motion, when it came [s], distance covered [m], Motion in the map)
        self._states: dict[str, tuple[Motion, float, float, Motion | None]] = {}
        self._text = ""  # all robots, as pages get them
        self._names: list[str] = []
        self._speeds: dict[str, dict[str, Any]] = {}  # robot -> v, w, age
        # robot -> {led1, led2, sound: name; bumpers: numbers of those that are pressed}
        self._kobukis: dict[str, dict[str, Any]] = {}

    def collect(self, clients: Sequence[Client], now: float) -> None:
        graph = self._graphs.graph
        # Also while no page looks: an LED keeps its colour.
        parts = [topic for topic, kind in graph.types.items() if kind in KOBUKI and BASE in topic]
        named = {topic.partition(BASE)[0].strip("/") for topic in parts}
        self._kobukis = {r: state for r, state in list(self._kobukis.items()) if r in named}
        self._feeds.set_subscriptions(
            (self, "kobuki"), dict.fromkeys(parts, self._hear_kobuki), every=True
        )
        watched = any(client.watch.robots for client in clients)
        known = graph.robots_with_odometry() if watched else ()
        truths = {topic_of(robot, TRUTH) for robot in known} & set(graph.published)
        topics = {topic_of(robot, "odom") for robot in known}
        topics |= {topic for topic in truths if graph.types.get(topic) == ODOMETRY}
        seen = {client.watch.look for client in clients if client.watch.floor} & {*graph.robots()}
        cores = {robot: topic_of(robot, CORE) for robot in seen}
        topics |= {topic for topic in cores.values() if graph.types.get(topic) == CORE_TYPE}
        self._feeds.set_subscriptions(self, dict.fromkeys(topics, self._hear), every=False)
        if not watched:
            self._states, self._text = {}, ""
            return
        for robot in known:
            self._read(robot)
        sensed = {robot: self._core(topic, now) for robot, topic in cores.items()}
        states = {r: shown(*state, now) for r, state in self._states.items() if r in known}
        self._names = sorted(graph.robots())
        kobukis = self._kobukis
        robots = {
            r: {**states.get(r, {}), **kobukis.get(r, {}), **sensed.get(r, {})} for r in self._names
        }
        speeds = {r: {name: state.get(name) for name in SPEED} for r, state in states.items()}
        self._speeds = speeds
        self._text = encoded("robots", robots=robots)

    def send_to(self, client: Client, now: float) -> None:
        if not client.watch.robots or not self._text:
            return
        # Also while all stand: it shows that the server is there.
        if client.watch.floor or client.seen.get("names") != self._names:
            client.seen["names"] = self._names
            client.write(self._text)
        elif now - client.seen.get("speed", 0.0) >= SPEED_S:
            client.seen["speed"] = now
            speed = self._speeds.get(client.watch.look or "", {})
            client.send("speed", **{name: v for name, v in speed.items() if v is not None})

    def moves(self, robot: str, now: float) -> bool:
        """Return whether the newest odometry says so; known while a page shows robots."""
        state, came, *_ = self._states.get(robot, (Motion(0, 0, 0, 0, 0), 0.0, 0.0, None))
        return now - came < FRESH_S and max(abs(state.v), abs(state.w)) > LEAST_SPEED

    def _hear(self, message: Raw, topic: str) -> None:
        self._newest[topic] = (message.data, time.monotonic())

    def _hear_kobuki(self, message: Raw, topic: str) -> None:
        robot, _, part = topic.partition(BASE)
        names = KOBUKI.get(self._graphs.graph.types.get(topic, ""), ())
        state, data = self._kobukis.setdefault(robot.strip("/"), {}), message.data
        if part == BUMPER and len(data) == BUMPER_BYTES and data[0] < BUMPERS:
            others = {*state.get("bumpers", ())} - {data[0]}
            state["bumpers"] = sorted(others | ({data[0]} if data[1] else set()))
        elif len(data) == 1 and data[0] < len(names):
            state[part.rpartition("/")[2]] = names[data[0]]

    def _core(self, topic: str, now: float) -> dict[str, str]:
        """Return what pages show of a Kobuki's sensors; {} if these are silent."""
        data, came = self._newest.get(topic, (b"", 0.0))
        core = read(SensorState, data) if now - came < CORE_FRESH_S else None
        return core_shown(core) if core else {}

    def _read(self, robot: str) -> None:
        data, came = self._newest.pop(topic_of(robot, "odom"), (b"", 0.0))
        odometry = read(Odometry, data)
        if odometry is None:  # nothing new, or malformed
            return
        new = motion(odometry)
        last, _, so_far, _ = self._states.get(robot, (new, 0.0, 0.0, None))
        truth = read(Odometry, self._newest.get(topic_of(robot, TRUTH), (b"", 0.0))[0])
        at = truth and motion(truth)
        self._states[robot] = (new, came, covered(last, new, so_far), at)


def place(state: Motion) -> dict[str, float]:
    """Return where a robot is [m, rad], as pages get it; {} if that is no place."""
    at = {"x": state.x, "y": state.y, "yaw": state.yaw}
    if not all(map(isfinite, at.values())) or max(abs(state.x), abs(state.y)) > FARTHEST_M:
        return {}
    return {name: round(value, DIGITS) for name, value in at.items()}


def shown(
    state: Motion, came: float, way: float, truth: Motion | None, now: float
) -> dict[str, Any]:
    """Return a robot's finite values as pages get them, its age in whole seconds.

    truth: where it is in the map, if that is known.
    """
    values = {"v": state.v, "w": state.w, "covered": way, "age": max(0, int(now - came))}
    finite = {name: round(value, DIGITS) for name, value in values.items() if isfinite(value)}
    return {**place(state), **finite, "truth": place(truth) if truth else {}}
