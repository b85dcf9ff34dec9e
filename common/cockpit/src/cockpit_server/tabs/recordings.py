"""What pages receive of a recording, and which recordings are kept. A file is read once."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, List, Mapping, Sequence

from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, Graph, topic_of
from cockpit_server.limits import MOST_PAGES
from cockpit_server.schema import MOST_FIELDS

Point = List[float]  # time [s], value
MOST_POINTS = 3000  # in a curve
MOST_CURVES, MOST_KEPT = MOST_PAGES * MOST_FIELDS, 20  # of a recording; recordings


@dataclass(eq=False)
class Recording:
    """What is in a bag."""

    path: Path
    duration: float  # [s]
    types: dict[str, str]  # topic -> type
    counts: dict[str, int]  # topic -> number of messages
    message: str  # what pages receive of it
    # field -> what pages receive of it; replaced, never changed
    curves: dict[str, str] = field(default_factory=dict)

    def keep(self, curves: dict[str, str]) -> None:
        """Add curves, and forget the oldest ones."""
        newest = list({**self.curves, **curves}.items())[-MOST_CURVES:]
        self.curves = dict(newest)

    def publishers(self, graph: Graph, robot: str) -> dict[str, list[str]]:
        """Return the other nodes that publish now where topics would be played.

        robot: whose joystick a recorded one moves.
        """
        places = {t: topic_of(robot, "joy") if kind == JOY else t for t, kind in self.types.items()}
        nodes = {t: graph.publishers.get(at, frozenset()) for t, at in places.items()}
        others = {topic: sorted(names - {graph.own_name}) for topic, names in nodes.items()}
        return {topic: names for topic, names in others.items() if names}


class Curve:
    """The points of a field. Of many messages the extremes are kept, so that no peak is lost."""

    def __init__(self, count: int) -> None:
        """count: of messages that will be added."""
        self._size = max(1, -(-2 * count // MOST_POINTS))  # messages of which two points are kept
        self._group: list[Point] = []
        self._points: list[Point] = []

    def add(self, t: float, value: float) -> None:
        self._group.append([round(t, 3), value])
        if len(self._group) == self._size:
            self._keep_extremes()

    def points(self) -> list[Point]:
        """Return the points without those inside a horizontal line."""
        self._keep_extremes()
        return corners(self._points)

    def _keep_extremes(self) -> None:
        if self._group:
            extremes = [choose(self._group, key=lambda point: point[1]) for choose in (min, max)]
            self._points += [p for p in self._group if p is extremes[0] or p is extremes[1]]
            self._group = []


def corners(points: list[Point]) -> list[Point]:
    """Return the points without those inside a horizontal line."""
    inner = [
        point
        for before, point, after in zip(points, points[1:], points[2:])
        if not before[1] == point[1] == after[1]
    ]
    return [*points[:1], *inner, *points[1:][-1:]]


class Shelf:
    """The recordings that were opened last. Used by one thread."""

    def __init__(self) -> None:
        self._kept: dict[Any, Recording] = {}  # by file; the last one was taken last

    def take(self, file: Any, read: Callable[[], Recording]) -> Recording:
        """Return the kept Recording of a file, or else read it."""
        taken = self._kept[file] = self._kept.pop(file) if file in self._kept else read()
        if len(self._kept) > MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        return taken


def playable(
    types: Mapping[str, str], topics: Sequence[str], published: Mapping[str, str]
) -> dict[str, str]:
    """Return the types of topics that can be played together. Raises RefusedError.

    types: of the recording. published: of the topics in the graph.
    """
    if not topics:
        raise RefusedError("choose a topic of the recording")
    for topic in topics:
        if topic not in types:
            raise RefusedError(f"the recording has no topic {topic!r}")
        if types[topic] != JOY and published.get(topic, types[topic]) != types[topic]:
            raise RefusedError(f"{topic} has the type {published[topic]} here")
    chosen = {topic: types[topic] for topic in topics}
    if list(chosen.values()).count(JOY) > 1:
        raise RefusedError("a robot has one joystick: choose one topic of the type Joy")
    return chosen
