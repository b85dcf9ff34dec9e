"""The bags that pages may open, and how they are read."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import Any, Collection, Dict, Iterable, Iterator, Tuple

import rosbag
import rospkg
import rospy

from cockpit_server.fields import by_topic, numbers_in, value_at
from cockpit_server.messages import decoded
from cockpit_server.pages import encoded
from cockpit_server.ros.tabs.recorded_types import Connection, connections
from cockpit_server.tabs.recordings import Curve, Recording
from gamepad.errors import BagError
from gamepad.ros.bags import opened

LARGEST = 200_000_000  # bytes, of a file, and of the messages that are played
MOST_TOPICS, MOST_MESSAGES = 2_000, 1_000_000
LONGEST_MESSAGE = 1_000_000  # bytes; a longer one has no curves
MOST_OFFERED = 5_000  # fields
MOST_NAMES = 100  # bags shown of this folder
Connections = Dict[str, Connection]  # by topic
RawMessage = Tuple[float, str, bytes]  # time since the start [s], topic, data


def bag_files(may_drive: bool) -> dict[str, Path]:
    """Return {name: path} of the suite's recording and, for drivers, the bags of this folder."""
    ours = Path(rospkg.RosPack().get_path("gamepad")) / "bag" / "joy.bag"
    here = sorted(filter(Path.is_file, Path.cwd().glob("*.bag"))) if may_drive else []
    return {path.name: path for path in [ours, *here[:MOST_NAMES]]}


def version(path: Path) -> tuple[Any, ...]:
    """Return a key that changes with the file. Raises BagError."""
    try:
        status = path.stat()
    except OSError as error:
        raise BagError(f"{path.name}: cannot be read: {error.strerror}") from None
    return path, status.st_mtime_ns, status.st_size


@contextmanager
def bag_at(path: Path) -> Iterator[tuple[rosbag.Bag, Connections]]:
    """Open a bag. Raises BagError, which names no folder."""
    try:
        with opened(path) as bag, connections(bag) as listed:
            # Of several nodes one that latches counts.
            known = sorted(listed, key=lambda about: about.is_latched)
            yield bag, {about.topic: about for about in known}
    except BagError as error:
        raise BagError(str(error).replace(str(path), path.name)) from None


def messages(
    bag: rosbag.Bag, known: Connections, topics: Collection[str], since: float = 0.0
) -> Iterator[RawMessage]:
    """Yield the messages of some topics. since: time since the start of the bag [s].

    Those of a second type on a topic are left out.
    """
    start = bag.get_start_time()
    options = {"topics": list(topics), "start_time": rospy.Time(start + since), "raw": True}
    for topic, (kind, data, md5sum, *_), stamp in bag.read_messages(**options) if topics else ():
        if (kind, md5sum) == (known[topic].type, known[topic].md5sum):
            yield stamp.to_sec() - start, topic, data


def read(path: Path) -> Recording:
    """Return the Recording of a file, without curves. Raises BagError, which names no folder."""
    name = path.name
    if path.is_file() and path.stat().st_size > LARGEST:
        raise BagError(f"{name}: larger than {LARGEST // 1_000_000} MB: use rosbag play")
    with bag_at(path) as (bag, known):
        topics = sorted(bag.get_type_and_topic_info().topics.items())
        counts = {topic: info.message_count for topic, info in topics}
        if not topics:
            raise BagError(f"{name}: is empty")
        if len(topics) > MOST_TOPICS or sum(counts.values()) > MOST_MESSAGES:
            most = f"{MOST_TOPICS:,} topics or {MOST_MESSAGES:,} messages"
            raise BagError(f"{name}: more than {most}: use rosbag play")
        start, end = bag.get_start_time(), bag.get_end_time()
        fields = [field for about in known.values() for field in fields_of(bag, about, end - start)]
    types = {topic: known[topic].type for topic in counts}
    rows = [{"name": t, "type": types[t], "count": count} for t, count in counts.items()]
    fields.sort(key=lambda field: ("header/" in field[0] or "covariance" in field[0], field))
    about = {"start": start, "end": end, "topics": rows, "fields": fields[:MOST_OFFERED]}
    return Recording(path, end - start, types, counts, encoded("bag", path=name, **about))


def fields_of(bag: rosbag.Bag, about: Connection, duration: float) -> list[tuple[str, int]]:
    """Return [(field, length of an array, or 0)] of a topic's first message and a middle one."""
    lengths: dict[str, int] = {}
    for since in (0.0, duration / 2):
        for _, topic, data in messages(bag, {about.topic: about}, [about.topic], since):
            for name, length in numbers_in(decoded(about.kind, data, LONGEST_MESSAGE)):
                field = f"{topic}/{name}"
                lengths[field] = max(length, lengths.get(field, 0))
            break
    return list(lengths.items())


def read_curves(recording: Recording, fields: Iterable[str]) -> dict[str, str]:
    """Return {field: what pages receive of it}. Raises BagError."""
    wanted = by_topic(fields, recording.types)
    curves = {f: Curve(recording.counts[topic]) for topic, of in wanted.items() for f in of}
    with bag_at(recording.path) as (bag, known):
        for t, topic, data in messages(bag, known, wanted):
            message = decoded(known[topic].kind, data, LONGEST_MESSAGE)
            for field, parts in wanted[topic].items():
                value = value_at(message, parts)
                if isinstance(value, float):
                    curves[field].add(t, value)
    points = {field: curve.points() for field, curve in curves.items()}
    return {f: encoded("bag_curve", field=f, points=points.get(f, [])) for f in fields}


def read_messages(path: Path, topics: Collection[str]) -> tuple[Connections, list[RawMessage]]:
    """Return the connections of these topics, and their messages in order. Raises BagError."""
    size, listed = 0, []
    with bag_at(path) as (bag, known):
        for message in messages(bag, known, topics):
            listed.append(message)
            size += len(message[2])
            if size > LARGEST:
                todo = "choose fewer topics, or use rosbag play"
                raise BagError(f"{path.name}: more than {LARGEST // 1_000_000} MB to play: {todo}")
    return {topic: known[topic] for topic in topics}, listed
