"""The newest lines that nodes have logged."""

import itertools
from collections import deque
from functools import lru_cache

from genpy import DeserializationError
from rosgraph_msgs.msg import Log

from cockpit_server.clients import Source

KEPT = 500  # lines
AT_ONCE = 50  # lines in a message to a page: many long ones would hold up who drives
LONGEST_LINE = 2000  # characters
LEVELS = {
    Log.DEBUG: "DEBUG", Log.INFO: "INFO", Log.WARN: "WARN", Log.ERROR: "ERROR", Log.FATAL: "FATAL",
}  # fmt: skip
TICKS = 2  # a message to pages each other time that they are looked after


@lru_cache(maxsize=KEPT)
def shown(data):
    """A line as pages get it, from the bytes of a rosgraph_msgs/Log; None if they are none."""
    try:
        log = Log().deserialize(data)
    except DeserializationError:
        return None
    return {
        "time": round(log.header.stamp.to_sec(), 3),
        "level": LEVELS.get(log.level, str(log.level)),
        "node": log.name,
        "text": log.msg[:LONGEST_LINE],
    }


class Logs(Source):
    """Keeps lines as they came, and reads them when a page wants to see them."""

    def __init__(self, feeds, graph_watch):
        """Listen for as long as the node runs. graph_watch: knows whether the node rosout runs."""
        self._feeds, self._graphs = feeds, graph_watch
        self._lines = deque(maxlen=KEPT)  # (number, bytes)
        self._numbers = itertools.count(1)
        self._ticks = 0

    def prepare(self, clients, now):
        """Listen to the node rosout, which gathers all lines, or where it is not to all nodes."""
        gathered = "/rosout_agg" in self._graphs.graph.publishers
        topic = "/rosout_agg" if gathered else "/rosout"
        self._feeds.want(self, {topic: self._hear}, every=True)
        self._ticks += 1

    def give(self, client, _now):
        """Send the lines that the client has not got."""
        if not client.watch.log or self._ticks % TICKS:
            return
        known = client.seen.get("log", 0)
        lines = [line for line in list(self._lines) if line[0] > known][:AT_ONCE]
        if lines or known == 0:
            client.seen["log"] = lines[-1][0] if lines else -1
            entries = [entry for entry in (shown(data) for _, data in lines) if entry]
            client.send("log", entries=entries)

    def _hear(self, message, _topic):
        self._lines.append((next(self._numbers), message.data))
