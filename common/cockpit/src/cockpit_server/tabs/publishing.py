"""Messages that a page publishes from a form: once, or repeatedly with the protection of driving.

The page sets the pace: what it does not send, or sends late, is not published. After a silence
nothing is published until a person starts again. A form that moves a robot makes its page the
driver, so that the end of the session, by any loss, publishes what stops the robot.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar, Mapping, Protocol, Sequence

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
from cockpit_server.schema import MILLISECONDS, full_name, number, or_null, switch, text, whole
from cockpit_server.tabs.form_values import TEXTS

SHORTEST_S, LONGEST_S = 0.02, 10.0  # between two messages
VELOCITY = "geometry_msgs/Twist"
SILENT = f"the page was silent for {SILENCE_S:g} s: publish again"


class Publishers(Protocol):
    """The publishers of forms: see ros/tabs/outlets.py."""

    def message(self, topic: str, type_name: str, values: Mapping[str, str]) -> Any: ...
    def send(self, topic: str, message: Any, now: float, is_due: bool = True) -> None: ...
    def send_rest(self, topic: str, message: Any) -> None: ...
    def collect(self, subscribers: Column, now: float) -> None: ...


@dataclass
class Held:
    """A message that a page publishes repeatedly, or a motion that it has started."""

    form: dict[str, Any]  # topic, type, values
    drives: bool  # whether the session of the page decides that the operator is lost
    fresh_at: float  # [s]
    delay: Delay = field(default_factory=Delay)


class Publishing(TabSource):
    """One message for each page that may drive, unless another page does."""

    messages: ClassVar = {
        "publish": {
            "topic": full_name, "type": text, "values": TEXTS,
            "period": or_null(number(SHORTEST_S, LONGEST_S)),
        },
        # A sign of life. due: whether to publish the message now.
        "again": {"n": whole, "t": MILLISECONDS, "beat": whole, "due": switch},
        "publish_end": {},
    }  # fmt: skip

    def __init__(self, driving: Driving, graphs: GraphWatcher, publishers: Publishers) -> None:
        self._driving, self._graphs, self._publishers = driving, graphs, publishers
        self._held: dict[int, Held] = {}  # by number of the page

    def collect(self, pages: Sequence[Page], now: float) -> None:
        open_pages = {page.number: page for page in pages}
        for page_number, held in list(self._held.items()):
            page = open_pages.get(page_number)
            is_silent = not held.drives and now - held.fresh_at > SILENCE_S
            if is_silent and page:
                page.refuse("again", SILENT)
            if is_silent or not page or not self._is_on(page, held):
                del self._held[page_number]
        self._publishers.collect(self._graphs.graph.subscribers, now)

    def _is_on(self, page: Page, held: Held) -> bool:
        return not held.drives or self._driving.publishes(page, held.form["topic"])

    def on_publish(self, page: Page, now: float, *, period: float | None, **form: Any) -> None:
        message = self._message(page, **form)
        rest, topic = rest_of(message), form["topic"]
        drives = rest is not None and bool(period or moves(message))
        if period or rest is not None:
            self.on_publish_end(page, now)
        if drives:
            send_rest = partial(self._publishers.send_rest, topic, rest)
            self._driving.publish(page, topic, send_rest, now)
        self._publishers.send(topic, message, now)
        if period or drives:
            self._held[page.number] = Held(form, drives, now)

    def on_again(self, page: Page, now: float, *, n: int, t: float, beat: int, due: bool) -> None:
        held = self._held.get(page.number)
        if held is None or not self._is_on(page, held):
            return  # It was sent before the page knew of the end.
        if held.drives:
            is_fresh = self._driving.session.sign(page.number, PageInput(n, t, beat, (), ()), now)
        else:
            is_fresh = held.delay.of(t, now) <= LATE_S
        if not is_fresh:
            return
        held.fresh_at = now
        try:
            message = self._message(page, **held.form)
        except RefusedError:
            self.on_publish_end(page, now)
            raise
        self._publishers.send(held.form["topic"], message, now, due)

    def on_publish_end(self, page: Page, _now: float) -> None:
        held = self._held.pop(page.number, None)
        if held and held.drives and self._is_on(page, held):
            self._driving.leave(page)

    def _message(self, page: Page, topic: str, type: str, values: Mapping[str, str]) -> Any:
        """Return a message that may be published. Raises RefusedError or ValueError."""
        self._driving.must_be_free(page)
        if self._graphs.graph.types.get(topic, type) != type:
            raise no_topic(topic, type)
        if type == JOY and topic.endswith("/joy"):
            raise RefusedError("a joystick is moved in the tab Robot, where a loss stops the robot")
        return self._publishers.message(topic, type, values)


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
