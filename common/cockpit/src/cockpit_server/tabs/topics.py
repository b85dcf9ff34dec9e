"""The topics in sight of a page: their rates, and the newest messages as text."""

from __future__ import annotations

import math
from collections import deque
from typing import ClassVar, Sequence

from cockpit_server.graph import GraphWatcher
from cockpit_server.messages import ReceivedMessage, Subscriptions
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import full_name, list_of, or_null
from node_kit.message_types import message_class

PERIOD_S = 0.25  # between two measurements
LONGEST_TEXT = 4000  # characters of a message
LONGEST_MESSAGE = 20_000  # bytes; the text of a longer message would delay the driver
WINDOW_S = 5.0  # over which the rate is measured
# After these seconds and mean periods without a message the rate is 0.
SILENT_S, SILENT_PERIODS = 2.0, 3.0
MOST_RATES = 40  # topics in sight of a page
MOST_TOPICS = 100  # measured for all pages together
ECHOED = 3  # messages of a period that are shown; others are only counted


class MeasuredTopic:
    """The rate of a topic, and its newest messages."""

    def __init__(self) -> None:
        self.is_echoed = False
        self.echo: list[tuple[int, str]] = []  # number and text of the newest messages
        self.rate = self.bytes_per_s = 0.0
        self._last = (0.0, 0, 0)  # arrival of the newest message [s]; messages, and bytes, so far
        self._marks: deque[tuple[float, int, int]] = deque()  # _last at past measurements
        self._newest: deque[tuple[int, bytes]] = deque(maxlen=ECHOED)

    def add(self, message: ReceivedMessage) -> None:
        _, count, size = self._last
        self._last = (message.arrived, count + 1, size + len(message.data))
        if self.is_echoed:
            self._newest.append((count + 1, message.data))

    def measure(self, type_name: str, now: float) -> None:
        """Update the echo, the rate [Hz] and the bytes per second; call about once in PERIOD_S."""
        newest, self._newest = self._newest, deque(maxlen=ECHOED)
        self.echo += [(number, text(data, type_name)) for number, data in newest]
        del self.echo[:-ECHOED]
        last, marks = self._last, self._marks
        if last[1] and (not marks or marks[-1] != last):
            marks.append(last)
        while len(marks) > 2 and marks[1][0] <= now - WINDOW_S:
            marks.popleft()
        self.rate = self.bytes_per_s = 0.0
        if len(marks) < 2:
            return
        duration, count, size = (new - old for new, old in zip(marks[-1], marks[0]))
        if now - last[0] > max(SILENT_S, SILENT_PERIODS * duration / count):
            marks.clear()
        elif duration > 0:
            self.rate, self.bytes_per_s = count / duration, size / duration


def text(data: bytes, type_name: str) -> str:
    """Return a message as text, or a line that says why it is not shown."""
    kind = message_class(type_name)
    if kind is None:
        return f"({len(data)} bytes; the package of {type_name} is not installed here)"
    if len(data) > LONGEST_MESSAGE:
        return f"({len(data)} bytes)"
    try:
        shown = str(kind().deserialize(data))
    except Exception as error:  # A message class may raise anything for malformed bytes.
        return f"(cannot be read: {error})"
    return shown if len(shown) <= LONGEST_TEXT else f"{shown[:LONGEST_TEXT]}\n..."


class Topics(TabSource):
    """The rates of the topics in sight of a page, and the messages of the chosen topic."""

    watches: ClassVar = {
        "topic": (or_null(full_name), None),
        "rates": (list_of(full_name, MOST_RATES), ()),
    }

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._topics: dict[str, MeasuredTopic] = {}
        self._measured_at = -math.inf  # [s]

    def collect(self, pages: Sequence[Page], now: float) -> None:
        chosen = {page.watch.topic for page in pages} - {None}
        rates = {name for page in pages for name in page.watch.rates}
        names = [*sorted(chosen), *sorted(rates - chosen)][:MOST_TOPICS]
        self._topics = {name: self._topics.get(name) or MeasuredTopic() for name in names}
        types = self._graphs.graph.types
        handlers = {name: topic.add for name, topic in self._topics.items() if name in types}
        self._subscriptions.set_subscriptions(self, handlers, every=True)
        is_due = now - self._measured_at >= PERIOD_S
        self._measured_at = now if is_due else self._measured_at
        for name, topic in self._topics.items():
            topic.is_echoed = name in chosen
            if is_due:
                topic.measure(types.get(name, ""), now)

    def send_to(self, page: Page, now: float) -> None:
        if page.watch.rates and page.take_if_new("rates", self._measured_at):
            topics = {n: self._topics[n] for n in page.watch.rates if n in self._topics}
            rates = {n: [round(t.rate, 2), round(t.bytes_per_s)] for n, t in topics.items()}
            page.send("rates", rates=rates)
        name = page.watch.topic
        topic = self._topics.get(name)
        seen, last = page.seen.get("echo", (name, 0))
        last = last if seen == name else 0
        echo = [(number, text) for number, text in topic.echo if number > last] if topic else []
        page.seen["echo"] = (name, echo[-1][0] if echo else last)
        if echo:
            page.send("topic", name=name, echo=echo)
