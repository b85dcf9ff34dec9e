"""Recordings: what is in them, and the joystick messages of each topic. Each is read once."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import Any, List, NamedTuple, Sequence

import rospkg

from cockpit_server.clients import encoded
from cockpit_server.driving.player import Message
from cockpit_server.graph import JOY
from gamepad.ros.bags import BagError, opened

Point = List[float]  # time [s], value
LARGEST = 200_000_000  # bytes
MOST_MESSAGES = 500_000  # [Joys] at 100 Hz more than an hour
MOST_POINTS = 3000  # in a curve
MOST_NAMES = 100  # files shown of this folder
MOST_KEPT = 20  # recordings


class Recording(NamedTuple):
    """What is in a bag."""

    duration: float  # [s]
    types: dict[str, str]  # Each topic has one.
    joys: dict[str, list[Message]]  # topic -> [(time since the start [s], axes, buttons)]
    message: str  # Pages get this of it.


def read(path: Path) -> Recording:
    """Return the Recording of a file. Raises BagError, which names no folder."""
    name = path.name
    try:
        if path.is_file() and path.stat().st_size > LARGEST:
            raise BagError(f"{name}: larger than {LARGEST // 1_000_000} MB: use rosbag play")
        with opened(path) as bag:
            topics = sorted(bag.get_type_and_topic_info().topics.items())
            if not topics:
                raise BagError(f"{name}: is empty")
            joys: dict[str, list[Message]] = {t: [] for t, one in topics if one.msg_type == JOY}
            if sum(one.message_count for topic, one in topics if topic in joys) > MOST_MESSAGES:
                raise BagError(f"{name}: too long: use rosbag play")
            start, end = bag.get_start_time(), bag.get_end_time()
            for topic, joy, stamp in bag.read_messages(topics=list(joys)) if joys else ():
                joys[topic].append((stamp.to_sec() - start, joy.axes, joy.buttons))
    except BagError as error:
        raise BagError(str(error).replace(str(path), name)) from None
    rows = [{"name": t, "type": one.msg_type, "count": one.message_count} for t, one in topics]
    message = encoded("bag", path=name, start=start, end=end, topics=rows, curves=curves(joys))
    return Recording(end - start, {t: one.msg_type for t, one in topics}, joys, message)


def curves(joys: dict[str, list[Message]]) -> dict[str, list[Point]]:
    """Return {"/joy/axes[0]": [[time [s], value], ...], ...}, finite values only."""
    found = {}
    for topic, messages in joys.items():
        step = len(messages) // MOST_POINTS + 1
        axes, buttons = [(t, a) for t, a, _ in messages], [(t, b) for t, _, b in messages]
        for kind, series in (("axes", axes), ("buttons", buttons)):
            for i in range(min((len(values) for _, values in series), default=0)):
                points = [
                    [round(t, 3), round(float(values[i]), 4)]
                    for t, values in series[::step]
                    if isfinite(values[i])
                ]
                found[f"{topic}/{kind}[{i}]"] = corners(points)
    return found


def corners(points: list[Point]) -> list[Point]:
    """Return the points without those inside a horizontal line."""
    inner = [
        point
        for before, point, after in zip(points, points[1:], points[2:])
        if not before[1] == point[1] == after[1]
    ]
    return [*points[:1], *inner, *points[1:][-1:]]


def recordings(may_drive: bool) -> dict[str, Path]:
    """Return {name: path} of the suite's recording and, for drivers, those of this folder."""
    ours = Path(rospkg.RosPack().get_path("gamepad")) / "bag" / "joy.bag"
    here = sorted(filter(Path.is_file, Path.cwd().glob("*.bag"))) if may_drive else []
    return {path.name: path for path in [ours, *here[:MOST_NAMES]]}


class Shelf:
    """The recordings that were read. Used by one thread, except in_use."""

    def __init__(self) -> None:
        self._read: dict[Any, Recording] = {}  # by what the file is; the last one was taken last
        self.in_use: Sequence[Recording] = ()  # that pages have open; replaced, never changed

    def take(self, path: Path) -> Recording:
        """Return the Recording of a file. Raises BagError."""
        try:
            about = path.stat()
        except OSError as error:
            raise BagError(f"{path.name}: cannot be read: {error.strerror}") from None
        key = (path, about.st_mtime_ns, about.st_size)
        taken = self._read.pop(key, None) or read(path)
        self._read[key] = taken
        self._make_room(taken)
        return taken

    def _make_room(self, newest: Recording) -> None:
        used = {id(one) for one in (*self.in_use, newest)}
        unused = [key for key, one in self._read.items() if id(one) not in used]
        while unused and (len(self._read) > MOST_KEPT or self._has_too_many()):
            del self._read[unused.pop(0)]
        if self._has_too_many() and len(self._read) > 1:
            self._read.popitem()
            raise BagError("other pages have long recordings open: close one of them")

    def _has_too_many(self) -> bool:
        recorded = [joys for one in self._read.values() for joys in one.joys.values()]
        return sum(map(len, recorded)) > MOST_MESSAGES
