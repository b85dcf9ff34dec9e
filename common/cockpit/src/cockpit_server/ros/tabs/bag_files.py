"""The bags that pages may open, and how they are read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import rospkg

from cockpit_server.driving.player import Message
from cockpit_server.graph import JOY
from cockpit_server.pages import encoded
from cockpit_server.tabs.recordings import MOST_MESSAGES, Recording, curves
from gamepad.errors import BagError
from gamepad.ros.bags import opened

LARGEST = 200_000_000  # bytes
MOST_NAMES = 100  # bags shown of this folder


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
            joys: dict[str, list[Message]] = {t: [] for t, info in topics if info.msg_type == JOY}
            if sum(info.message_count for topic, info in topics if topic in joys) > MOST_MESSAGES:
                raise BagError(f"{name}: too long: use rosbag play")
            start, end = bag.get_start_time(), bag.get_end_time()
            for topic, joy, stamp in bag.read_messages(topics=list(joys)) if joys else ():
                joys[topic].append((stamp.to_sec() - start, joy.axes, joy.buttons))
    except BagError as error:
        raise BagError(str(error).replace(str(path), name)) from None
    rows = [{"name": t, "type": info.msg_type, "count": info.message_count} for t, info in topics]
    message = encoded("bag", path=name, start=start, end=end, topics=rows, curves=curves(joys))
    return Recording(end - start, {t: info.msg_type for t, info in topics}, joys, message)
