"""The tab Frames: the tree of tf, what is wrong with its edges, and one transform."""

from __future__ import annotations

import re
from collections import defaultdict, deque
from math import asin, atan2, degrees, inf
from typing import Any, Callable, ClassVar, Hashable, Mapping, NamedTuple, Protocol, Sequence

from geometry_msgs.msg import Transform, TransformStamped

from cockpit_server.graph import TF, TF_STATIC, Column, GraphWatcher
from cockpit_server.messages import ReceivedMessage
from cockpit_server.pages import Page, TabSource, encoded
from cockpit_server.schema import LONGEST_TEXT, list_of, or_null, text
from cockpit_server.tabs.topics import SILENT_PERIODS, SILENT_S, WINDOW_S
from node_kit.rules.throttle import Throttle

RATE = 2.0  # how often pages receive the tree [1/s]
MOST_EDGES = 300
MOST_ARRIVALS = 250  # 50 Hz in the window
MOST_PUBLISHERS = 4  # nodes
WRONG_STAMP_S = 1.0  # amcl and others set stamps some tenths of a second in the future


class Publisher(NamedTuple):
    """What publishes an edge."""

    topic: str
    node: str
    parent: str


class Edge:
    """How the place of a frame in its parent is published. Times are those of ROS's clock [s]."""

    def __init__(self) -> None:
        self._publishers: dict[Publisher, float] = {}  # and its newest arrival
        self._arrivals: deque[float] = deque(maxlen=MOST_ARRIVALS)
        self._stamp = self._refused = -inf  # newest [s]
        self._refusal = ""

    def add(self, new: Publisher, stamp: float, refusal: str, now: float) -> None:
        def is_kept(old: Publisher, at: float) -> bool:
            if old.topic == TF_STATIC:  # The newest message of its node is latched.
                return old[:2] != new[:2]
            return old != new and now - at < WINDOW_S

        kept = [(old, at) for old, at in self._publishers.items() if is_kept(old, at)]
        self._publishers = dict([*kept[1 - MOST_PUBLISHERS :], (new, now)])
        self._arrivals.append(now)
        while len(self._arrivals) > 2 and self._arrivals[0] < now - WINDOW_S:
            self._arrivals.popleft()
        self._stamp = stamp
        if refusal:
            self._refusal, self._refused = refusal, now

    def shown(self, publishers: Column, now: float) -> dict[str, Any]:
        """Return the edge as pages receive it. publishers: of topics, as the master knows them."""
        known, arrivals = list(self._publishers), list(self._arrivals)
        running = [key for key in known if key.node in publishers.get(key.topic, ())]
        nodes = sorted({key.node for key in running or known})
        parents = sorted({key.parent for key in running or known})
        is_static = all(key.topic == TF_STATIC for key in running or known)
        silence, gaps = now - arrivals[-1], len(arrivals) - 1
        period = (arrivals[-1] - arrivals[0]) / gaps if gaps else WINDOW_S
        is_silent = not is_static and silence > max(SILENT_S, SILENT_PERIODS * period)
        problems = [
            len(nodes) > 1 and f"{len(nodes)} nodes publish it: {', '.join(nodes)}",
            len(parents) > 1 and f"{len(parents)} parents: {', '.join(parents)}",
            is_silent and f"nothing for {silence:.1f} s",
            not running and silence > SILENT_S and "its node has exited",
            not is_static and wrong_stamp(self._stamp, arrivals[-1]),
            now - self._refused < WINDOW_S and f"tf2 refuses it: {self._refusal}",
        ]
        return {
            "parent": parents[0],
            "nodes": nodes,
            "static": is_static,
            "rate": round(1 / period, 1) if gaps and period and not is_silent else 0,
            "age": round(now - self._stamp, 2) if self._stamp else None,
            "problems": [problem for problem in problems if problem],
        }


def wrong_stamp(stamp: float, arrived: float) -> str:
    """Return what is wrong with the stamp of a transform that arrived at a time [s], or ""."""
    if not stamp:
        return "its stamp is 0: set header.stamp"
    side = "past" if arrived > stamp else "future"
    error_s = abs(arrived - stamp)
    return f"its stamp is {error_s:.1f} s in the {side}" if error_s > WRONG_STAMP_S else ""


def tree(parents: Mapping[str, str]) -> dict[str, int]:
    """Return the depth of each frame of {frame: parent}, in the order of the tree.

    A loop has no root: its first frame has depth 0.
    """
    children: dict[str, list[str]] = defaultdict(list)
    for frame in sorted(parents, key=by_number, reverse=True):
        children[parents[frame]].append(frame)
    depths: dict[str, int] = {}
    roots = sorted({*children} - {*parents}, key=by_number)
    for start in (*roots, *sorted(parents)):
        waiting = [(start, 0)]
        while waiting:
            frame, depth = waiting.pop()
            if frame not in depths:
                depths[frame] = depth
                waiting += [(child, depth + 1) for child in children[frame]]
    return depths


def by_number(name: str) -> list[Any]:
    """Return the key by which sorted() puts robot_2 before robot_10."""
    return [int(part) if part.isdecimal() else part for part in re.split(r"(\d+)", name)]


def text_of(transform: Transform) -> str:
    """Return a transform as text. As in tf_echo, its angles are about the fixed axes x, y, z."""
    place, turn = transform.translation, transform.rotation
    x, y, z, w = turn.x, turn.y, turn.z, turn.w
    roll = atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    yaw = atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return (
        f"x, y, z: {fixed(3, place.x, place.y, place.z)} m\n"
        f"roll, pitch, yaw: {fixed(1, *map(degrees, (roll, pitch, yaw)))} degrees\n"
        f"quaternion x, y, z, w: {fixed(3, x, y, z, w)}"
    )


def fixed(digits: int, *numbers: float) -> str:
    """Return numbers as text, without -0.0."""
    return ", ".join(f"{round(number, digits) + 0.0:.{digits}f}" for number in numbers)


class Tf(Protocol):
    """What tabs use of ros/transforms.py."""

    def set_needed(self, owner: Hashable, is_needed: bool) -> None: ...
    def lookup(
        self, target: str, source: str, stamp: Any = None
    ) -> tuple[Transform | None, str]: ...


class Frames(TabSource):
    """The edges of tf, for pages that watch them; a page may name two frames, [target, source]."""

    watches: ClassVar = {"frames": (or_null(list_of(text, 2)), None)}

    def __init__(self, tf: Tf, graphs: GraphWatcher, ros_time: Callable[[], float]) -> None:
        self._tf, self._graphs, self._ros_time = tf, graphs, ros_time
        self._edges: dict[str, Edge] = {}  # by child
        self._may_send, self._at = Throttle(RATE), -inf
        self._text = ""

    def on_transform(
        self, stamped: TransformStamped, message: ReceivedMessage, refusal: str, now: float
    ) -> None:
        names = (stamped.child_frame_id, stamped.header.frame_id)
        child, parent = (name[:LONGEST_TEXT] or "(no name)" for name in names)
        edge = self._edges.get(child) or Edge()
        publisher = Publisher(message.topic, message.sender, parent)
        edge.add(publisher, stamped.header.stamp.to_sec(), refusal, now)
        if len(self._edges) < MOST_EDGES:
            self._edges[child] = edge

    def on_clear(self) -> None:
        self._edges.clear()

    def collect(self, pages: Sequence[Page], now: float) -> None:
        is_watched = any(page.watch.frames is not None for page in pages)
        self._tf.set_needed(self, is_watched)
        if is_watched and self._may_send.ready(now):
            self._at = now
            self._write(self._ros_time())

    def _write(self, now: float) -> None:
        publishers = self._graphs.graph.publishers
        edges = {f: edge.shown(publishers, now) for f, edge in list(self._edges.items())}
        depths = tree({frame: edge["parent"] for frame, edge in edges.items()})
        for frame, depth in depths.items():
            if depth == 0 and frame in edges:
                edges[frame]["problems"].append("its parents form a loop")
        rows = [{"frame": f, "depth": d, **edges.get(f, {})} for f, d in depths.items()]
        is_published = TF in publishers or TF_STATIC in publishers
        is_full = len(edges) >= MOST_EDGES
        self._text = encoded("frames", rows=rows, published=is_published, full=is_full)

    def send_to(self, page: Page, now: float) -> None:
        pair = page.watch.frames
        if pair is None or not self._text:
            return
        if page.take_if_new("frames", self._at):
            page.write(self._text)
        if len(pair) == 2 and page.take_if_new("transform", (self._at, pair)):
            transform, why = self._tf.lookup(*pair)
            page.send("transform", text=text_of(transform) if transform else why)
