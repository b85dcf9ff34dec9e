"""What pages receive of a recording, and which recordings are kept. A file is read once."""

from __future__ import annotations

from math import isfinite
from typing import Any, Callable, List, NamedTuple, Sequence

from cockpit_server.driving.player import Message
from cockpit_server.errors import RefusedError

Point = List[float]  # time [s], value
MOST_MESSAGES = 500_000  # [Joys] more than an hour at 100 Hz
MOST_POINTS = 3000  # in a curve
MOST_KEPT = 20  # recordings


class Recording(NamedTuple):
    """What is in a bag."""

    duration: float  # [s]
    types: dict[str, str]  # topic -> type
    joys: dict[str, list[Message]]  # topic -> [(time since the start [s], axes, buttons)]
    message: str  # what pages receive of it


def curves(joys: dict[str, list[Message]]) -> dict[str, list[Point]]:
    """Return {"/joy/axes[0]": [[time [s], value], ...], ...}, finite values only."""
    points = {}
    for topic, messages in joys.items():
        step = len(messages) // MOST_POINTS + 1
        axes, buttons = [(t, a) for t, a, _ in messages], [(t, b) for t, _, b in messages]
        for kind, series in (("axes", axes), ("buttons", buttons)):
            for i in range(min((len(values) for _, values in series), default=0)):
                points[f"{topic}/{kind}[{i}]"] = corners([
                    [round(t, 3), round(float(values[i]), 4)]
                    for t, values in series[::step]
                    if isfinite(values[i])
                ])  # fmt: skip
    return points


def corners(points: list[Point]) -> list[Point]:
    """Return the points without those inside a horizontal line."""
    inner = [
        point
        for before, point, after in zip(points, points[1:], points[2:])
        if not before[1] == point[1] == after[1]
    ]
    return [*points[:1], *inner, *points[1:][-1:]]


class Shelf:
    """The recordings that are kept. Used by one thread, except in_use."""

    def __init__(self) -> None:
        self._kept: dict[Any, Recording] = {}  # by file; the last one was taken last
        self.in_use: Sequence[Recording] = ()  # open on a page; replaced, never changed

    def take(self, file: Any, read: Callable[[], Recording]) -> Recording:
        """Return the kept Recording of a file, or else read it. Raises RefusedError."""
        taken = self._kept.pop(file, None) or read()
        self._kept[file] = taken
        self._make_room(taken)
        return taken

    def _make_room(self, newest: Recording) -> None:
        used = {id(recording) for recording in (*self.in_use, newest)}
        unused = [file for file, recording in self._kept.items() if id(recording) not in used]
        while unused and (len(self._kept) > MOST_KEPT or self._has_too_many()):
            del self._kept[unused.pop(0)]
        if self._has_too_many() and len(self._kept) > 1:
            self._kept.popitem()
            raise RefusedError("other pages have long recordings open: close one of them")

    def _has_too_many(self) -> bool:
        joys = (joys for recording in self._kept.values() for joys in recording.joys.values())
        return sum(map(len, joys)) > MOST_MESSAGES
