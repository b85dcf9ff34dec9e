"""Messages that a page publishes from a form: once, or repeatedly with the protection of driving.

The page sets the pace: what it does not send, or sends late, is not published. After a silence
nothing is published until a person starts again. A form that moves a robot makes its page the
driver, so that the end of the session, by any loss, publishes what stops the robot. A page has one
motion at a time, because a session has one topic, which is named above every tab.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar, Iterable, Mapping, Protocol, Sequence

from cockpit_server.driving.driver_session import (
    LATE_S,
    SILENCE_S,
    Delay,
    PageInput,
    is_neutral,
    neutral_of,
)
from cockpit_server.driving.who_drives import Driving
from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, Column, GraphWatcher
from cockpit_server.pages import Page, TabSource
from cockpit_server.schema import MILLISECONDS, full_name, number, or_null, text, whole
from cockpit_server.tabs.form_values import TEXTS

SHORTEST_S, LONGEST_S = 0.02, 10.0  # between two messages
# Topics of a page, and messages a second on all of them; see limits.SHARE.
MOST_TOPICS, MOST_HZ = 8, 100.0
VELOCITY = "geometry_msgs/Twist"
# After a longer silence what moves nothing is not taken up again; meanwhile nothing is published.
SILENCE_AT_REST_S = 2.0
SILENT = f"the page was silent for {SILENCE_AT_REST_S:g} s: publish again"


class Publishers(Protocol):
    """The publishers of forms: see ros/tabs/outlets.py."""

    def message(self, topic: str, type_name: str, values: Mapping[str, str], i: int) -> Any: ...
    def send(self, topic: str, message: Any, now: float) -> None: ...
    def keep(self, topic: str, type_name: str, now: float) -> None: ...
    def send_rest(self, topic: str, message: Any) -> None: ...
    def collect(self, subscribers: Column, now: float) -> None: ...


@dataclass
class Held:
    """A message that a page publishes repeatedly, or a motion that it has started."""

    form: dict[str, Any]  # topic, type, values
    period: float | None  # [s]; None: published once
    drives: bool  # whether the session of the page decides that the operator is lost
    fresh_at: float  # [s]
    delay: Delay = field(default_factory=Delay)
    count: int = 1  # messages that were published


class Publishing(TabSource):
    """The messages of each page that may drive, unless another page does: one on a topic."""

    messages: ClassVar = {
        "publish": {
            "topic": full_name, "type": text, "values": TEXTS,
            "period": or_null(number(SHORTEST_S, LONGEST_S)),
        },
        # A sign of life. due: the topic on which to publish now.
        "again": {"n": whole, "t": MILLISECONDS, "beat": whole, "due": or_null(full_name)},
        "publish_end": {"topic": or_null(full_name)},  # null: all
    }  # fmt: skip

    def __init__(self, driving: Driving, graphs: GraphWatcher, publishers: Publishers) -> None:
        self._driving, self._graphs, self._publishers = driving, graphs, publishers
        self._held: dict[int, dict[str, Held]] = {}  # by number of the page, and topic

    def collect(self, pages: Sequence[Page], now: float) -> None:
        open_pages = {page.number: page for page in pages}
        self._held = {n: held for n, held in self._held.items() if held and n in open_pages}
        for page_number, topics in self._held.items():
            for topic, held in list(topics.items()):
                is_silent = not held.drives and now - held.fresh_at > SILENCE_AT_REST_S
                if is_silent:
                    open_pages[page_number].refuse("again", f"{topic}: {SILENT}")
                if is_silent or not self._is_on(open_pages[page_number], held):
                    del topics[topic]
                else:
                    self._publishers.keep(topic, held.form["type"], now)
        self._publishers.collect(self._graphs.graph.subscribers, now)

    def send_to(self, page: Page, now: float) -> None:
        running = [
            {"topic": topic, "type": held.form["type"], "period": held.period, "count": held.count}
            for topic, held in self._held.get(page.number, {}).items()
        ]
        if page.take_if_new("running", running or None):
            page.send("running", topics=running)

    def _is_on(self, page: Page, held: Held) -> bool:
        return not held.drives or self._driving.publishes(page, held.form["topic"])

    def on_publish(self, page: Page, now: float, *, period: float | None, **form: Any) -> None:
        message = self._message(page, **form)
        rest, topic = rest_of(message), form["topic"]
        drives = rest is not None and bool(period or moves(message))
        topics = self._held.setdefault(page.number, {})
        if period:
            check_bounds([*(held for name, held in topics.items() if name != topic)], period)
        if rest is not None:
            self._end(page, [name for name, held in topics.items() if held.drives])
        if drives:
            send_rest = partial(self._publishers.send_rest, topic, rest)
            self._driving.publish(page, topic, send_rest, now)
        self._publishers.send(topic, message, now)
        if period or drives:  # The page signs once it is sent what runs.
            topics[topic] = Held(form, period, drives, now + SILENCE_S)

    def on_again(
        self, page: Page, now: float, *, n: int, t: float, beat: int, due: str | None
    ) -> None:
        sign = PageInput(n, t, beat, (), ())
        for topic, held in list(self._held.get(page.number, {}).items()):
            if not self._is_fresh(page, held, sign, now):
                continue
            held.fresh_at = now
            if topic == due:
                self._publish_again(page, held, now)

    def _is_fresh(self, page: Page, held: Held, sign: PageInput, now: float) -> bool:
        if not held.drives:
            return held.delay.of(sign.t, now) <= LATE_S
        # It may have been sent before the page knew of the end.
        return self._is_on(page, held) and self._driving.session.sign(page.number, sign, now)

    def _publish_again(self, page: Page, held: Held, now: float) -> None:
        topic, i = held.form["topic"], held.count + 1
        try:
            message = self._message(page, **held.form, i=i)
        except (RefusedError, ValueError) as error:
            self._end(page, [topic])
            raise RefusedError(f"{error} (message {i} on {topic})") from None
        held.count = i
        self._publishers.send(topic, message, now)

    def on_publish_end(self, page: Page, _now: float, topic: str | None) -> None:
        self._end(page, list(self._held.get(page.number, {})) if topic is None else [topic])

    def _end(self, page: Page, topics: Iterable[str]) -> None:
        for topic in topics:
            held = self._held.get(page.number, {}).pop(topic, None)
            if held and held.drives and self._is_on(page, held):
                self._driving.leave(page)

    def _message(
        self, page: Page, topic: str, type: str, values: Mapping[str, str], i: int = 1
    ) -> Any:
        """Return a message that may be published. Raises RefusedError or ValueError."""
        self._driving.must_be_free(page)
        graph = self._graphs.graph
        is_used = topic in graph.publishers or topic in graph.subscribers  # types has old ones, too
        if is_used and graph.types.get(topic, type) != type:
            raise no_topic(topic, type)
        if type == JOY and topic.endswith("/joy"):
            raise RefusedError("a joystick is moved in the tab Robot, where a loss stops the robot")
        return self._publishers.message(topic, type, values, i)


def check_bounds(others: Sequence[Held], period: float) -> None:
    """Raise RefusedError if a page would publish on too many topics, or too often."""
    hertz = 1 / period + sum(1 / held.period for held in others if held.period)
    if len(others) >= MOST_TOPICS or hertz > MOST_HZ:
        most = f"on {MOST_TOPICS} topics, {MOST_HZ:g} messages per second in all"
        raise RefusedError(f"a page publishes at most {most}: stop some of them first")


def no_topic(topic: str, type_name: str) -> RefusedError:
    return RefusedError(f"{topic}: no topic of the type {type_name}")


def rest_of(message: Any) -> Any:
    """Return the message that ends the motion of a message; None if its type moves nothing."""
    rest = type(message)()
    if message._type == JOY:
        rest.axes, rest.buttons = neutral_of(message.axes, message.buttons)
    elif message._type != VELOCITY:
        return None
    return rest


def moves(message: Any) -> bool:
    if message._type == JOY:
        return not is_neutral(message.axes, message.buttons)
    return message != rest_of(message)
