"""The robots: where they are, and the state of a Kobuki's parts."""

from __future__ import annotations

from math import isfinite
from typing import Any, Callable, ClassVar, Sequence

from geometry_msgs.msg import Transform
from kobuki_msgs.msg import SensorState
from nav_msgs.msg import Odometry

from cockpit_server.graph import ODOMETRY, GraphWatcher, topic_of
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource, encoded
from cockpit_server.schema import switch
from cockpit_server.tabs.kobuki import core_shown
from cockpit_server.tabs.motion import FARTHEST_M, Motion, covered, in_frame, motion

DIGITS = 4  # after the point [m]: a tenth of a millimetre
KOBUKI = {  # type of a command -> what its values mean
    "kobuki_msgs/BumperEvent": (),
    "kobuki_msgs/Led": ("off", "green", "orange", "red"),
    "kobuki_msgs/Sound": (
        "on", "off", "recharge", "button", "error", "cleaningstart", "cleaningend",
    ),
}  # fmt: skip
BASE, BUMPER, TRUTH = "/mobile_base/", "events/bumper", "base_pose_ground_truth"
CORE, CORE_TYPE = "mobile_base/sensors/core", "kobuki_msgs/SensorState"
BUMPERS, BUMPER_BYTES = 3, 2  # bytes of an event: which bumper, and whether it is pressed
SPEED, SPEED_S = ("v", "w", "age"), 0.25  # how often a page without the floor receives these
CORE_FRESH_S = 2.0  # Older values of a Kobuki's sensors are not shown.
FRESH_S, LEAST_SPEED = 1.0, 0.01  # [s], [m/s, rad/s]: newer and faster odometry is motion


class Robots(TabSource):
    """All robots, with the newest odometry of each, for the pages that show them."""

    # floor: everything about them, 20 times a second; else the speed of the robot in sight
    watches: ClassVar = {"robots": (switch, False), "floor": (switch, False)}

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._newest: dict[str, tuple[bytes, float]] = {}  # topic -> (bytes, their arrival [s])
        # robot -> (Motion, its arrival [s], distance covered [m], Motion in the map)
        self._states: dict[str, tuple[Motion, float, float, Motion | None]] = {}
        self.frames: dict[str, str] = {}  # robot -> the frame of its odometry
        # Of points in such a frame; None if it is unknown.
        self.transform_to_map: Callable[[str], Transform | None] = lambda _: None
        self._text = ""  # all robots, as pages receive them
        self._names: list[str] = []
        self._speeds: dict[str, dict[str, Any]] = {}  # robot -> v, w, age
        # robot -> {led1, led2, sound: name; bumpers: numbers of the pressed ones}
        self._kobukis: dict[str, dict[str, Any]] = {}

    def collect(self, pages: Sequence[Page], now: float) -> None:
        graph = self._graphs.graph
        self._collect_kobukis()
        is_watched = any(page.watch.robots for page in pages)
        known = graph.robots_with_odometry() if is_watched else set()
        truths = {topic_of(robot, TRUTH) for robot in known} & set(graph.published)
        topics = {topic_of(robot, "odom") for robot in known}
        topics |= {topic for topic in truths if graph.types.get(topic) == ODOMETRY}
        in_sight = {page.watch.look for page in pages if page.watch.floor} & graph.robots()
        cores = {robot: topic_of(robot, CORE) for robot in in_sight}
        topics |= {topic for topic in cores.values() if graph.types.get(topic) == CORE_TYPE}
        handlers = dict.fromkeys(topics, self._on_message)
        self._subscriptions.set_subscriptions(self, handlers, every=False)
        if is_watched:
            sensors = {robot: self._core(topic, now) for robot, topic in cores.items()}
            self._write(known, sensors, now)
        else:
            self._states, self._text, self.frames = {}, "", {}

    def _collect_kobukis(self) -> None:
        """Subscribe to Kobukis' parts even if no page shows them, as an LED keeps its colour."""
        types = self._graphs.graph.types.items()
        parts = [topic for topic, kind in types if kind in KOBUKI and BASE in topic]
        robots = {topic.partition(BASE)[0].strip("/") for topic in parts}
        self._kobukis = {r: state for r, state in list(self._kobukis.items()) if r in robots}
        handlers = dict.fromkeys(parts, self._on_kobuki)
        self._subscriptions.set_subscriptions((self, "kobuki"), handlers, every=True)

    def _write(self, known: set[str], sensors: dict[str, dict[str, str]], now: float) -> None:
        """Write what pages receive. known: the robots with odometry. sensors: by robot."""
        for robot in known:
            self._decode(robot)
        states = {r: shown(*state, now) for r, state in self._states.items() if r in known}
        self._names = sorted(self._graphs.graph.robots())
        parts = (states, self._kobukis, sensors)
        robots = {
            robot: {key: value for part in parts for key, value in part.get(robot, {}).items()}
            for robot in self._names
        }
        self._speeds = {r: {key: state.get(key) for key in SPEED} for r, state in states.items()}
        self._text = encoded("robots", robots=robots)

    def send_to(self, page: Page, now: float) -> None:
        if not page.watch.robots or not self._text:
            return
        # Also while no robot moves, as it shows that the server runs.
        if page.watch.floor or page.seen.get("names") != self._names:
            page.seen["names"] = self._names
            page.write(self._text)
        elif now - page.seen.get("speed", 0.0) >= SPEED_S:
            page.seen["speed"] = now
            speed = self._speeds.get(page.watch.look or "", {})
            page.send("speed", **{name: v for name, v in speed.items() if v is not None})

    def moves(self, robot: str, now: float) -> bool:
        """Return whether the newest odometry shows motion; known while a page shows robots."""
        state, arrived, *_ = self._states.get(robot, (Motion(0, 0, 0, 0, 0), 0.0, 0.0, None))
        return now - arrived < FRESH_S and max(abs(state.v), abs(state.w)) > LEAST_SPEED

    def _on_message(self, message: ReceivedMessage) -> None:
        self._newest[message.topic] = (message.data, message.arrived)

    def _on_kobuki(self, message: ReceivedMessage) -> None:
        robot, _, part = message.topic.partition(BASE)
        names = KOBUKI.get(self._graphs.graph.types.get(message.topic, ""), ())
        state, data = self._kobukis.setdefault(robot.strip("/"), {}), message.data
        if part == BUMPER and len(data) == BUMPER_BYTES and data[0] < BUMPERS:
            others = {*state.get("bumpers", ())} - {data[0]}
            state["bumpers"] = sorted(others | ({data[0]} if data[1] else set()))
        elif len(data) == 1 and data[0] < len(names):
            state[part.rpartition("/")[2]] = names[data[0]]

    def _core(self, topic: str, now: float) -> dict[str, str]:
        """Return what pages show of a Kobuki's sensors; {} if they are silent."""
        data, arrived = self._newest.get(topic, (b"", 0.0))
        core = decoded(SensorState, data) if now - arrived < CORE_FRESH_S else None
        return core_shown(core) if core else {}

    def _decode(self, robot: str) -> None:
        data, arrived = self._newest.pop(topic_of(robot, "odom"), (b"", 0.0))
        odometry = decoded(Odometry, data)
        if odometry is None:  # nothing new, or malformed
            return
        new = motion(odometry)
        last, _, so_far, _ = self._states.get(robot, (new, 0.0, 0.0, None))
        truth = decoded(Odometry, self._newest.get(topic_of(robot, TRUTH), (b"", 0.0))[0])
        self.frames[robot] = frame = odometry.header.frame_id.lstrip("/")
        to_map = None if truth else self.transform_to_map(frame)
        in_map = motion(truth) if truth else to_map and in_frame(new, to_map)
        self._states[robot] = (new, arrived, covered(last, new, so_far), in_map)


def place(state: Motion) -> dict[str, float]:
    """Return the pose of a robot [m, rad] as pages receive it; {} if it is impossible."""
    pose = {"x": state.x, "y": state.y, "yaw": state.yaw}
    if not all(map(isfinite, pose.values())) or max(abs(state.x), abs(state.y)) > FARTHEST_M:
        return {}
    return {name: round(value, DIGITS) for name, value in pose.items()}


def shown(
    state: Motion, arrived: float, distance: float, truth: Motion | None, now: float
) -> dict[str, Any]:
    """Return a robot's finite values as pages receive them, its age in whole seconds.

    truth: its Motion in the map, if known.
    """
    values = {"v": state.v, "w": state.w, "covered": distance, "age": max(0, int(now - arrived))}
    finite = {name: round(value, DIGITS) for name, value in values.items() if isfinite(value)}
    return {**place(state), **finite, "truth": place(truth) if truth else {}}
