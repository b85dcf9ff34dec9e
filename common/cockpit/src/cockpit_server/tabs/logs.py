"""The newest lines that nodes have logged, and lines of the doctor, as pages receive them."""

from __future__ import annotations

import itertools
import re
from collections import deque
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar

from rosgraph_msgs.msg import Log

from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import switch

KEPT = 1000  # lines, as many as a page keeps
AT_ONCE = 50  # lines in a message to a page: many long ones would delay the driver
LONGEST_LINE, LONGEST_NAME = 2000, 300  # characters
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
    """Return a line as pages receive it, or None if it is malformed."""
    log = decoded(Log, data)
    if log is None:
        return None
    place = f"{log.file[:LONGEST_NAME]}:{log.line}({log.function[:LONGEST_NAME]})"
    return {
        "time": round(log.header.stamp.to_sec(), 3),
        "level": LEVELS.get(log.level, str(log.level)),
        "node": log.name[:LONGEST_NAME],
        "place": without_folders(place) if log.file else "",
        "text": without_folders(log.msg[:LONGEST_LINE]),
    }


def doctor_line(line: str) -> dict[str, str]:
    """Return a line of the doctor as pages receive it."""
    level, subject, text = [*line.split(maxsplit=2), "", "", ""][:3]
    if level not in ("ok", "wrong", "unknown"):
        subject, text = "", line
    level = level if level in ("ok", "wrong") else "note"
    return {"level": level, "subject": subject, "text": without_folders(text.strip())}


class Logs(TabSource):
    """The newest lines as bytes, which are decoded when a page shows the log."""

    watches: ClassVar = {"log": (switch, False)}

    def __init__(self, subscriptions: Subscriptions) -> None:
        """Subscribe for as long as the node runs.

        To /rosout, where the last line of every node is latched; /rosout_agg sends new lines alone.
        """
        self._lines: deque[tuple[int, bytes]] = deque(maxlen=KEPT)  # numbered
        self._numbers = itertools.count(1)
        subscriptions.set_subscriptions(self, {"/rosout": self._on_line}, every=True)

    def send_to(self, page: Page, now: float) -> None:
        if not page.watch.log:
            return
        known = page.seen.get("log", 0)
        lines = [line for line in list(self._lines) if line[0] > known][:AT_ONCE]
        if lines or known == 0:
            page.seen["log"] = lines[-1][0] if lines else -1
            entries = [entry for entry in (shown(data) for _, data in lines) if entry]
            page.send("log", entries=entries)

    def _on_line(self, message: ReceivedMessage) -> None:
        if all(data != message.data for _, data in list(self._lines)):  # else latched, sent again
            self._lines.append((next(self._numbers), message.data))
