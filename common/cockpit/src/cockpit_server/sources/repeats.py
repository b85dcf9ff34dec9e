"""Messages that a driver's page publishes again and again, with the protection that driving has.

The page gives the beat: what it does not send, or sends late, is not published. After a silence
there is a zero velocity, where velocities were published, and nothing more until a person begins.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Sequence

from cockpit_server.clients import Client, RefusedError, Source
from cockpit_server.driving.driver_session import LATE_S, SILENCE_S, Delay
from cockpit_server.schema import MILLISECONDS, number
from cockpit_server.sources.forms import Forms

SHORTEST_S, LONGEST_S = 0.02, 10.0  # between two messages


@dataclass
class Repeat:
    """What a page publishes, and how often."""

    message: dict[str, Any]  # topic, type, values
    period: float  # [s]
    fresh_at: float  # [s]
    delay: Delay = field(default_factory=Delay)


class Repeats(Source):
    """At most one message of each page."""

    messages: ClassVar = {
        "repeat": {**Forms.messages["publish"], "period": number(SHORTEST_S, LONGEST_S)},
        "again": {"t": MILLISECONDS},
        "repeat_end": {},
    }

    def __init__(self, forms: Forms) -> None:
        self._forms = forms
        self._repeats: dict[int, Repeat] = {}  # by page

    def collect(self, clients: Sequence[Client], now: float) -> None:
        here = {client.number for client in clients}
        for page, one in list(self._repeats.items()):
            if page not in here or now - one.fresh_at > one.period + SILENCE_S:
                self._end(page)

    def on_repeat(self, client: Client, now: float, *, period: float, **message: Any) -> None:
        self._end(client.number)
        self._forms.on_publish(client, now, **message)
        self._repeats[client.number] = Repeat(message, period, now)

    def on_again(self, client: Client, now: float, t: float) -> None:
        one = self._repeats.get(client.number)
        if one is None:
            raise RefusedError("the page was silent for too long: publish again")
        if one.delay.of(t, now) > LATE_S:
            return
        one.fresh_at = now
        try:
            self._forms.on_publish(client, now, **one.message)
        except RefusedError:
            self._end(client.number)
            raise

    def on_repeat_end(self, client: Client, _now: float) -> None:
        self._end(client.number)

    def _end(self, page: int) -> None:
        one = self._repeats.pop(page, None)
        if one:
            self._forms.rest(one.message["topic"], one.message["type"])
