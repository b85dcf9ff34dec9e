"""The newest lines that nodes have logged."""

from __future__ import annotations

import itertools
import re
from collections import deque
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar

from rosgraph_msgs.msg import Log

from cockpit_server.clients import Client, Source
from cockpit_server.ros.feeds import Feeds, Raw, read
from cockpit_server.schema import switch

KEPT = 1000  # lines, as many as a page keeps
AT_ONCE = 50  # lines in a message to a page: many long ones would hold up the driver
LONGEST_LINE = 2000  # characters
LEVELS = {getattr(Log, name): name for name in ("DEBUG", "INFO", "WARN", "ERROR", "FATAL")}


def without_folders(text: str, home: str | None = None, here: str | None = None) -> str:
    """Return a text with the working directory as "." and the home directory as "~"."""
    folders = ((here or str(Path.cwd()), "."), (home or str(Path.home()), "~"))
    for folder, short in folders:
        if folder != "/":
            text = re.sub(re.escape(folder) + r"(?![\w.-])", short, text)
    return text


@lru_cache(maxsize=KEPT)
def shown(data: bytes) -> dict[str, Any] | None:
    """Return a line as pages get it, or None if the bytes are no Log."""
    log = read(Log, data)
    if log is None:
        return None
    return {
        "time": round(log.header.stamp.to_sec(), 3),
        "level": LEVELS.get(log.level, str(log.level)),
        "node": log.name,
        "text": without_folders(log.msg[:LONGEST_LINE]),
    }


class Logs(Source):
    """Keeps lines as bytes, and decodes them when a page shows the log."""

    watches: ClassVar = {"log": (switch, False)}

    def __init__(self, feeds: Feeds) -> None:
        """Subscribe for as long as the node runs: to /rosout, where each node's last line is
        latched, and not to /rosout_agg, which sends nothing that was logged before.
        """
        self._lines: deque[tuple[int, bytes]] = deque(maxlen=KEPT)  # numbered
        self._numbers = itertools.count(1)
        feeds.set_subscriptions(self, {"/rosout": self._hear}, every=True)

    def send_to(self, client: Client, now: float) -> None:
        if not client.watch.log:
            return
        known = client.seen.get("log", 0)
        lines = [line for line in list(self._lines) if line[0] > known][:AT_ONCE]
        if lines or known == 0:
            client.seen["log"] = lines[-1][0] if lines else -1
            entries = [entry for entry in (shown(data) for _, data in lines) if entry]
            client.send("log", entries=entries)

    def _hear(self, message: Raw, _topic: str) -> None:
        if all(data != message.data for _, data in list(self._lines)):  # latched, heard again
            self._lines.append((next(self._numbers), message.data))
