"""What nodes report on /diagnostics: each status, and when its level changed."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple, Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from cockpit_server.limits import Budget
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import switch
from node_kit.rules.throttle import Throttle

TOPICS = {"/diagnostics": "", "/diagnostics_agg": "/diagnostics_agg/"}  # and what precedes names
LEVELS = {getattr(DiagnosticStatus, name): name for name in ("OK", "WARN", "ERROR", "STALE")}
STALE, STALE_S = "STALE", 5.0  # An older status is stale, about as in rqt_runtime_monitor.
MOST, MOST_VALUES, LONGEST_TEXT = 100, 30, 100  # statuses of a topic, values of each; characters
LONGEST_ARRAY = 200_000  # bytes
# What reading an array costs; all together get limits.SHARE of a thread.
READ_S, READ_BYTE_S, BURST_S = 1e-4, 1e-7, 0.05


class Status(NamedTuple):
    """A status as it was reported last."""

    level: str
    message: str
    values: list[tuple[str, str]]
    changed: float | None  # when the level did [s], None if that is unknown
    arrived: float  # [s]

    def at(self, now: float) -> Status:
        """Return it as it is at a time [s]: stale, if it is old."""
        end = self.arrived + STALE_S
        return self if now < end or self.level == STALE else self._replace(level=STALE, changed=end)


class Diagnostics(TabSource):
    """The newest statuses, while a page shows them."""

    watches: ClassVar = {"diagnostics": (switch, False)}

    def __init__(self, subscriptions: Subscriptions) -> None:
        self._subscriptions = subscriptions
        self._statuses: dict[str, dict[str, Status]] = {}  # topic -> name -> its status
        self._list: list[tuple[Any, ...]] = []  # all of them, as pages receive them
        self._reading, self._may_list = Budget(BURST_S, 0.0), Throttle(1.0)

    def collect(self, pages: Sequence[Page], now: float) -> None:
        is_watched = any(page.watch.diagnostics for page in pages)
        handlers = dict.fromkeys(TOPICS if is_watched else (), self._on_array)
        self._subscriptions.set_subscriptions(self, handlers, every=True)
        if not is_watched:
            self._statuses, self._list = {}, []
        elif self._may_list.ready(now):
            known = [item for topic in TOPICS for item in self._statuses.get(topic, {}).items()]
            self._list = [(name, *status.at(now)[:-1]) for name, status in known]

    def send_to(self, page: Page, now: float) -> None:
        if page.watch.diagnostics and page.take_if_new("diagnostics", self._list):
            page.send("diagnostics", now=now, statuses=self._list)

    def _on_array(self, message: ReceivedMessage) -> None:
        if self._reading.wait_s(message.arrived):
            return
        self._reading.spend(READ_S + READ_BYTE_S * len(message.data))
        array = decoded(DiagnosticArray, message.data, LONGEST_ARRAY)
        statuses = dict(self._statuses.get(message.topic, {}))
        for new in array.status[:MOST] if array else ():
            name = shown(TOPICS[message.topic] + new.name)
            statuses[name] = newest(new, message.arrived, statuses.get(name))
        for name in sorted(statuses, key=lambda name: statuses[name].arrived)[:-MOST]:
            del statuses[name]
        self._statuses[message.topic] = statuses


def newest(new: DiagnosticStatus, now: float, last: Status | None) -> Status:
    """Return a status that arrives now [s]. last: what was known of it."""
    level = LEVELS.get(new.level, "ERROR")
    before = last and last.at(now)
    changed = now if before and before.level != level else before and before.changed
    pairs = [("hardware_id", new.hardware_id), *((pair.key, pair.value) for pair in new.values)]
    values = [(shown(key), shown(value)) for key, value in pairs[:MOST_VALUES]]
    return Status(level, shown(new.message), values, changed, now)


def shown(text: str) -> str:
    """Return the beginning of a text, in a line."""
    return " ".join(text[:LONGEST_TEXT].split())
