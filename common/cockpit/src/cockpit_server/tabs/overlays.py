"""Scans, paths and markers on the floor, in the frames of tf, and the floor's own frame."""

from __future__ import annotations

import itertools
from collections import deque
from math import inf
from typing import Any, Callable, Mapping, Sequence

from geometry_msgs.msg import Transform
from nav_msgs.msg import Path
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

from cockpit_server.graph import Graph, GraphWatcher, topic_of
from cockpit_server.limits import MOST_PAGES, Budget
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource, encoded
from cockpit_server.tabs.frames import Tf
from cockpit_server.tabs.maps import Maps
from cockpit_server.tabs.robots import TRUTH, Robots
from cockpit_server.tabs.shapes import DIGITS, Shape, Shapes, update

NEWEST = {kind._type: kind for kind in (LaserScan, Path)}  # Only the newest counts.
KINDS = {**NEWEST, Marker._type: Marker, MarkerArray._type: MarkerArray}
# The suite's markers of what the floor has anyway: the map, pressed bumpers and robots.
DRAWN_ANYWAY = ("/world_markers", "/bumper_markers", "/classroom_bodies")
POSE_TOPICS = ("initialpose", "move_base_simple/goal")  # The page publishes these.
ROOTS = ("map", "odom")  # frames of a floor without a map and odometry
MOST_TOPICS, MOST_WAITING = 10, 50  # topics; messages
LONGEST = 300_000  # bytes of a message
# The time to read a byte of small markers, and to place a shape; that of larger ones is less.
BYTE_S, SHAPE_S, BURST_S = 5e-7, 2e-4, 0.02
AGAIN_S = 0.1  # until a shape is placed again that moves with its frame, or has no known frame
MOST_POINTS = 5_000  # of a topic, on a page


class Layer:
    """What a topic shows. texts: frame of the floor -> (end of its validity [s], message)."""

    def __init__(self, kind: str) -> None:
        self.kind, self.turn = kind, 0
        self.waiting: deque[ReceivedMessage] = deque(maxlen=1 if kind in NEWEST else MOST_WAITING)
        self.shapes: Shapes = {}
        self.texts: dict[str, tuple[float, str]] = {}

    def is_old(self, frame: str, now: float) -> bool:
        return now >= self.texts.get(frame, (0.0, ""))[0]


class Overlays(TabSource):
    """What nodes show of the robot in sight, or of no robot, for pages that show the floor."""

    def __init__(
        self, subscriptions: Subscriptions, graphs: GraphWatcher, tf: Tf, robots: Robots,
        maps: Maps, submit: Callable[..., Any],
    ) -> None:  # fmt: skip
        """submit: calls a function in a thread, which the driver need not wait for."""
        self._subscriptions, self._graphs, self._tf = subscriptions, graphs, tf
        self._robots, self._maps = robots, maps
        robots.transform_to_map = self._transform_to_map
        self._graph = Graph()
        self._looks: frozenset[str] = frozenset()  # the robots in sight
        self._topics: dict[str, Mapping[str, str]] = {}  # of each -> {topic: type}
        self._floors: dict[str, str] = {}  # of each -> the frame
        self._layers: dict[str, Layer] = {}
        self._budget, self._turns = Budget(BURST_S, 0.0), itertools.count(1)
        self._submit, self._drawn = submit, submit(lambda: None)

    def collect(self, pages: Sequence[Page], now: float) -> None:
        looks = frozenset(page.watch.look or "" for page in pages if page.watch.floor)
        if (self._graphs.graph, looks) != (self._graph, self._looks):
            self._graph, self._looks = self._graphs.graph, looks
            self._topics = {robot: topics_shown(self._graph, robot) for robot in looks}
        topics = {topic: kind for its in self._topics.values() for topic, kind in its.items()}
        for topic, layer in list(self._layers.items()):
            if topics.get(topic) != layer.kind:
                del self._layers[topic]
        for topic in topics.keys() - self._layers.keys():
            self._layers[topic] = Layer(topics[topic])
        for is_newest in (True, False):
            its = {t for t, layer in self._layers.items() if (layer.kind in NEWEST) is is_newest}
            handlers = dict.fromkeys(its, self._on_message)
            owner = self, is_newest
            self._subscriptions.set_subscriptions(owner, handlers, every=not is_newest)
        self._floors = {robot: self._frame(robot) for robot in looks}
        jobs = [
            (topic, self._layers[topic], robot, self._floors[robot])
            for robot, its in self._topics.items() for topic in its
            if self._layers[topic].waiting or self._layers[topic].is_old(self._floors[robot], now)
        ]  # fmt: skip
        if jobs and self._drawn.done() and not self._budget.wait_s(now):
            last, self._drawn = self._drawn, self._submit(self._draw, jobs, now)
            last.result()  # The hub reports what failed.
        truths = {topic_of(robot, TRUTH) for robot in looks & self._robots.frames.keys()}
        is_lost = bool(self._maps.frame) and bool(truths - self._graph.publishers.keys())
        has_shapes = any(layer.shapes for layer in self._layers.values())
        self._tf.set_needed(self, is_lost or has_shapes)

    def _transform_to_map(self, frame: str) -> Transform | None:
        return self._tf.lookup(self._maps.frame, frame)[0] if self._maps.frame else None

    def _on_message(self, message: ReceivedMessage) -> None:
        layer = self._layers.get(message.topic)
        if layer and len(message.data) <= LONGEST:
            layer.waiting.append(message)

    def _draw(self, jobs: Sequence[tuple[str, Layer, str, str]], now: float) -> None:
        """Read what has arrived, and write what pages receive of it."""
        self._read([layer for _, layer, _, _ in jobs], now)
        for job in jobs:
            self._write(*job, now)

    def _read(self, layers: Sequence[Layer], now: float) -> None:
        """Read messages, the topics in turn, as far as the budget allows."""
        while not self._budget.wait_s(now):
            waiting = [layer for layer in layers if layer.waiting]
            if not waiting:
                return
            layer = min(waiting, key=lambda layer: layer.turn)
            layer.turn = next(self._turns)
            raw = layer.waiting.popleft()
            message = decoded(KINDS[layer.kind], raw.data, as_arrays=True)
            if message:
                update(layer.shapes, message, raw.arrived)
                layer.texts = {frame: (0.0, text) for frame, (_, text) in layer.texts.items()}
            self._budget.spend(BYTE_S * len(raw.data))

    def send_to(self, page: Page, now: float) -> None:
        robot = page.watch.look or ""
        if not page.watch.floor or robot not in self._floors:
            return
        topics, frame = self._topics[robot], self._floors[robot]
        subscribed = [t for t in POSE_TOPICS if topic_of(robot, t) in self._graph.subscribers]
        if page.take_if_new("floor", (frame, subscribed)):
            page.send("floor", frame=frame, subscribed=subscribed)
        sent: dict[str, str] = page.seen.setdefault("overlays", {})
        for topic in {*sent, *topics}:
            text = self._layers[topic].texts.get(frame, ("", ""))[1] if topic in topics else ""
            if text != sent.pop(topic, ""):
                page.write(text or encoded("overlay", topic=topic, shapes=[]))
            if text:
                sent[topic] = text

    def _frame(self, robot: str) -> str:
        """Return the frame of the floor: that of its map or its robot, or else of what it shows."""
        frame = self._maps.frame or self._robots.frames.get(robot)
        if frame:
            return frame
        layers = [self._layers[topic] for topic in self._topics.get(robot, ())]
        frames = [shape.frame for layer in layers for shape in list(layer.shapes.values())[:1]]
        roots = [root for root in ROOTS if frames and self._tf.lookup(root, frames[0])[0]]
        return [*roots, *frames, ROOTS[0]][0]

    def _write(self, topic: str, layer: Layer, robot: str, frame: str, now: float) -> None:
        """Write the message with a topic's shapes on the floor of a frame, or ""."""
        if not layer.is_old(frame, now):
            return
        layer.shapes = {key: shape for key, shape in layer.shapes.items() if now < shape.until}
        rows: list[dict[str, Any]] = []
        end, left = inf, MOST_POINTS
        for shape in layer.shapes.values():
            is_placed = self._place(shape, frame)
            is_still = is_placed and not shape.is_locked
            end = min(end, shape.until, inf if is_still else now + AGAIN_S)
            points, above = shape.placed.get(frame, []), {}
            if not is_placed and topic == topic_of(robot, "scan"):
                points, above = shape.points[:, :2].round(DIGITS).tolist(), {"robot": robot}
            left -= len(points)
            if points and left >= 0:
                kind = "area" if shape.kind == "solid" else shape.kind
                rows.append({"as": kind, "points": points, **shape.style, **above})
        text = encoded("overlay", topic=topic, shapes=rows) if rows else ""
        if len(layer.texts) >= MOST_PAGES:
            layer.texts.clear()
        layer.texts[frame] = end, text

    def _place(self, shape: Shape, frame: str) -> bool:
        """Place a shape on the floor of a frame; return whether it is in its place."""
        if frame in shape.placed and not shape.is_locked:
            return True
        transform: Transform | None = Transform()  # None: unknown
        if shape.frame != frame:
            stamp = None if shape.is_locked else shape.header.stamp
            transform, _ = self._tf.lookup(frame, shape.frame, stamp)
        self._budget.spend(SHAPE_S)
        shape.placed.pop(frame, None)
        if transform:
            shape.place(frame, transform)
        return bool(transform)


def topics_shown(graph: Graph, robot: str) -> dict[str, str]:
    """Return {topic: type} of what the floor shows while a robot, or none (""), is in sight."""
    names = sorted(graph.robots(), key=len, reverse=True)
    owners = [topic_of(name, "") for name in names]  # a topic's owner is the first that it is below
    none = topic_of(robot, "")
    shown: dict[str, str] = {}
    for topic in graph.published:
        kind = graph.types.get(topic, "")
        if kind not in KINDS or topic.endswith(DRAWN_ANYWAY) or len(shown) >= MOST_TOPICS:
            continue
        if next(filter(topic.startswith, owners), none) == none:
            shown[topic] = kind
    return shown
